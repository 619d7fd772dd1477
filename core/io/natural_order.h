// The order in which people count file names: 1, 3, ..., 101.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace gyre {

// Runs of digits compare as numbers, all else byte by byte. A strict total order: names that count
// alike ("1", "01") are ordered by their bytes.
struct NaturalOrder {
  using is_transparent = void;
  bool operator()(std::string_view a, std::string_view b) const;
};

}  // namespace gyre
