// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/marker_dictionary.h"

#include <gtest/gtest.h>
#include <opencv2/aruco.hpp>

namespace gyre {
namespace {

TEST(MarkerDictionary, KnowsOpenCvsNamesAndNoOthers) {
  ASSERT_TRUE(markerDictionary("DICT_5X5_250"));
  EXPECT_EQ(markerDictionary("DICT_5X5_250")->markers, 250);
  EXPECT_FALSE(markerDictionary("DICT_5X5_251"));
  EXPECT_FALSE(markerDictionary(""));
}

TEST(MarkerDictionary, CountsWhatOpenCvHolds) {
  for (const int bits : {4, 5, 6, 7}) {
    for (const int count : {50, 100, 250, 1000}) {
      const std::string side = std::to_string(bits);
      const auto known =
          markerDictionary("DICT_" + side + "X" + side + "_" + std::to_string(count));
      ASSERT_TRUE(known);
      const auto codes = cv::aruco::getPredefinedDictionary(known->opencv_number);
      EXPECT_EQ(codes->bytesList.rows, known->markers);
      EXPECT_EQ(codes->markerSize, known->bits_a_side);
    }
  }
}

// OpenCV's own drawing of a marker, one pixel a module, is the truth.
TEST(MarkerDictionary, GivesTheModulesThatOpenCvDraws) {
  for (const char* name : {"DICT_4X4_50", "DICT_5X5_250", "DICT_7X7_1000", "DICT_ARUCO_ORIGINAL"}) {
    const auto dictionary = markerDictionary(name);
    ASSERT_TRUE(dictionary);
    for (const int id : {0, 1, 17, dictionary->markers - 1}) {
      cv::Mat drawn;
      cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(dictionary->opencv_number), id,
                            dictionary->modulesASide(), drawn);
      const auto modules = markerModules(*dictionary, id);
      ASSERT_EQ(modules.size(), drawn.total());
      for (std::size_t i = 0; i < modules.size(); ++i) {
        EXPECT_EQ(modules[i] != 0, drawn.data[i] > 127) << name << " " << id << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace gyre
