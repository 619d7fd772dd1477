// Damages bytes at random, the same way every time: what a reader must survive.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/base/random.h"

namespace gyre {

// One to eight of: a byte replaced, a byte removed, a piece repeated, the end cut off.
inline std::string mutated(std::string bytes, std::uint64_t seed) {
  Random random(seed);
  const auto changes = 1 + random.below(8);
  for (std::uint64_t i = 0; i < changes && !bytes.empty(); ++i) {
    const auto at = static_cast<std::size_t>(random.below(bytes.size()));
    switch (random.below(8)) {
      case 0:
        bytes.erase(at, 1);
        break;
      case 1:
        bytes.insert(at, bytes.substr(at, static_cast<std::size_t>(random.below(16))));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes[at] = "0123456789-.e \n\""[random.below(16)];
        break;
      default:
        bytes[at] = static_cast<char>(random.below(256));
    }
  }
  return bytes;
}

}  // namespace gyre
