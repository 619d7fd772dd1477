// Finds coded squares and reads their ids.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/frame.h"

namespace gyre {

using MarkerCorners = std::array<Eigen::Vector2d, 4>;  // pixels, in TargetMarker's order

struct DetectedMarker {
  int id = 0;
  MarkerCorners corners{};  // to about a pixel; refineMarker() knows them better
};

struct MarkerDetection {
  std::vector<DetectedMarker> markers;    // by ascending id, as often as seen
  std::vector<MarkerCorners> unreadable;  // dark quadrangles without a code of the dictionary
};

// In a CV_8U grey picture. Fails for a dictionary nobody knows.
// Garrido-Jurado et al., "Automatic generation and detection of highly reliable fiducial markers
// under occlusion" (2014), by OpenCV.
Result<MarkerDetection> detectMarkers(const cv::Mat& grey, const std::string& dictionary);

// Another dictionary of which the picture shows more codes than chance would, three or more, and
// how many: the printed target is not the one that is looked for. Empty when there is none.
struct ForeignMarkers {
  std::string dictionary;
  int markers = 0;
};
ForeignMarkers findForeignMarkers(const cv::Mat& grey, const std::string& but_not_dictionary);

}  // namespace gyre
