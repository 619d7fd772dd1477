// The families of coded squares that targets may carry: OpenCV's predefined ArUco dictionaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace gyre {

struct MarkerDictionary {
  std::string_view name;  // "DICT_5X5_250"
  int opencv_number = 0;  // its value in OpenCV's enumeration
  int bits_a_side = 0;    // without the black border, which is one bit wide
  int markers = 0;        // ids are 0 to markers - 1
  int modulesASide() const { return bits_a_side + 2; }
};

// The dictionary of that name, or nothing when there is none.
std::optional<MarkerDictionary> markerDictionary(std::string_view name);

// Row by row from the top left, border included: 1 is white. The id must be one of the dictionary.
std::vector<std::uint8_t> markerModules(const MarkerDictionary& dictionary, int id);

}  // namespace gyre
