// What the live picture shows of a calibration target, while it is being put in place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// One face of the target in the picture.
struct FaceSight {
  int seen = 0;         // points found
  int points = 0;       // points it has
  bool passes = false;  // enough of them to measure from
};

struct TargetSight {
  std::vector<Eigen::Vector2f> found_px;  // raw picture coordinates
  std::vector<FaceSight> faces;           // of the target, in its order
  bool passes = false;                    // good enough to begin
  std::string sentence;                   // what is seen or what hinders, and what to try
};

}  // namespace gyre
