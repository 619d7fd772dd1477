// How far the table turned between pictures, told by what they show.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/units.h"
#include "core/geometry/rigid3.h"

namespace gyre {

// The same spot in two views, undistorted, on the plane z = 1.
struct ViewMatch {
  Eigen::Vector2d first;
  Eigen::Vector2d second;
};

// What the views of a turn have in common. What stands still must be left out.
struct TurnMatches {
  std::vector<std::vector<ViewMatch>> pairs;  // of each view with the next
  // Of views so many apart: small steps alone say little of their size.
  std::size_t stride = 1;
  std::vector<ViewMatch> wide;     // of all such pairs together
  std::vector<ViewMatch> closing;  // of the last view with the first, or none
};

struct TurnStepsOptions {
  // How far matches may miss each other's epipolar lines; over the focal length, > 0.
  double tolerance = 1e-3;
  // Turns of wide pairs are looked for between these, either way round. [rad]
  double least_step_rad = radFromDeg(0.3);
  double most_step_rad = radFromDeg(60.0);
  // No point of the object is further from the axis than this: seen from afar, all steps have much
  // the same epipolar lines, but the wrong ones ask for objects of another size. [mm], > 0
  double most_radius_mm = 1e9;
  // Fewer matches than this say nothing of a step of their own.
  std::size_t least_matches = 12;
};

struct TurnSteps {
  std::vector<double> steps_rad;  // one a pair; counter-clockwise from above is positive
  double common_rad = 0.0;        // what all pairs together say of one step
  double scatter_rad = 0.0;       // standard deviation of the steps about their middle
  std::size_t agreeing = 0;       // matches that agree with their step
  bool closed = false;            // the last view met the first: the steps make whole turns
};

// The step that most wide matches agree on, one for all, is found first, then each pair's own near
// it; where the closing pair agrees with whole turns, what is missing to them is spread over all
// steps. The camera's place tells the direction as well. From afar a larger step of a flatter
// object looks much the same: among steps that are told apart badly, one that makes a single whole
// turn is believed.
//
// cam_from_table: at any table angle, as only turns count. kTooFew when the matches do not single
// out a step. Fitzgibbon, Cross and Zisserman, "Automatic 3D model construction for turn-table
// sequences" (1998), with a camera that is known; Sampson's distance.
Result<TurnSteps> turnSteps(const TurnMatches& matches, const Rigid3& cam_from_table,
                            const TurnStepsOptions& options);

}  // namespace gyre
