// What a live picture shows of the target, fast enough to be drawn over the preview.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/calib/find_target.h"

namespace gyre {

struct PreviewFace {
  int face = -1;  // index into the target's faces, -1 for markers of none
  int seen = 0;
  int expected = 0;
  bool pass = false;  // at least half of its points
};

struct TargetPreview {
  bool pass = false;                    // a picture like this one can be used
  std::vector<Eigen::Vector2d> points;  // where they were found, raw picture coordinates
  std::vector<PreviewFace> faces;       // those of which anything was seen
  std::string sentence;                 // what was found, or what hinders and what to try
};

// As findTarget(), on a picture reduced to at most 800 px: points are good to about half a pixel,
// which is what an overlay needs.
TargetPreview previewTarget(const cv::Mat& image, const Target& target,
                            const FindTargetOptions& options = {});

}  // namespace gyre
