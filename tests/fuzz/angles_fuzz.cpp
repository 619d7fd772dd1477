// Gives any bytes to the reader of angles.csv.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "core/io/angles_file.h"
#include "tests/fuzz/fuzz_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto angles = gyre::parseAngles(gyre::fuzz::textOf(bytes, size), "fuzzed");
  gyre::fuzz::checkSentence(angles);
  if (!angles) return 0;
  GYRE_CHECK(!angles->empty());
  for (const auto& [picture, angle_rad] : *angles) {
    GYRE_CHECK(!picture.empty() && std::isfinite(angle_rad));
  }
  return 0;
}
