// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/marker_dictionary.h"

#include <algorithm>
#include <array>

#include <opencv2/aruco/dictionary.hpp>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr std::array<MarkerDictionary, 17> kDictionaries = {{
    {"DICT_4X4_50", cv::aruco::DICT_4X4_50, 4, 50},
    {"DICT_4X4_100", cv::aruco::DICT_4X4_100, 4, 100},
    {"DICT_4X4_250", cv::aruco::DICT_4X4_250, 4, 250},
    {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000, 4, 1000},
    {"DICT_5X5_50", cv::aruco::DICT_5X5_50, 5, 50},
    {"DICT_5X5_100", cv::aruco::DICT_5X5_100, 5, 100},
    {"DICT_5X5_250", cv::aruco::DICT_5X5_250, 5, 250},
    {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000, 5, 1000},
    {"DICT_6X6_50", cv::aruco::DICT_6X6_50, 6, 50},
    {"DICT_6X6_100", cv::aruco::DICT_6X6_100, 6, 100},
    {"DICT_6X6_250", cv::aruco::DICT_6X6_250, 6, 250},
    {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000, 6, 1000},
    {"DICT_7X7_50", cv::aruco::DICT_7X7_50, 7, 50},
    {"DICT_7X7_100", cv::aruco::DICT_7X7_100, 7, 100},
    {"DICT_7X7_250", cv::aruco::DICT_7X7_250, 7, 250},
    {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000, 7, 1000},
    {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL, 5, 1024},
}};

}  // namespace

std::optional<MarkerDictionary> markerDictionary(std::string_view name) {
  const auto* found = std::find_if(kDictionaries.begin(), kDictionaries.end(),
                                   [&](const MarkerDictionary& each) { return each.name == name; });
  if (found == kDictionaries.end()) return std::nullopt;
  return *found;
}

std::vector<std::uint8_t> markerModules(const MarkerDictionary& dictionary, int id) {
  GYRE_CHECK(id >= 0 && id < dictionary.markers);
  const auto codes = cv::aruco::getPredefinedDictionary(dictionary.opencv_number);
  const cv::Mat bits =
      cv::aruco::Dictionary::getBitsFromByteList(codes->bytesList.row(id), codes->markerSize);
  const int side = dictionary.modulesASide();
  GYRE_CHECK(bits.rows == dictionary.bits_a_side && bits.cols == dictionary.bits_a_side);
  std::vector<std::uint8_t> modules(static_cast<std::size_t>(side * side), 0);
  for (int y = 0; y < bits.rows; ++y) {
    for (int x = 0; x < bits.cols; ++x) {
      modules[static_cast<std::size_t>((y + 1) * side + x + 1)] =
          bits.at<std::uint8_t>(y, x) != 0 ? 1 : 0;
    }
  }
  return modules;
}

}  // namespace gyre
