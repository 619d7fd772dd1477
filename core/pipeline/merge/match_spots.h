// Lays one pass on another by the spots that both show.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/pipeline/merge/surface_spots.h"

namespace gyre {

// The same spot of the object in two frames.
struct SpotPair {
  Eigen::Vector3d fixed;  // mm
  Eigen::Vector3d moving;
  Eigen::Vector3d fixed_normal;  // unit
  Eigen::Vector3d moving_normal;
};

// For each moving spot the fixed one with the most similar descriptor, where those of all other
// places (farther than apart_mm from it) are clearly less similar. Many pairs are wrong.
std::vector<SpotPair> pairSpots(const SurfaceSpots& fixed, const SurfaceSpots& moving,
                                double apart_mm);

struct SpotAgreement {
  Rigid3 fixed_from_moving;
  std::vector<SpotPair> pairs;  // that agree with it
};

// The motion with which most pairs agree to tolerance_mm, and with normals to 45 degrees: by random
// threes of pairs, then least squares over those that agree. Nothing when too few agree for chance
// to be ruled out, or when all of them lie on a line. The same input gives the same answer; nothing
// also when stopped. Fischler and Bolles, "Random sample consensus" (1981).
std::optional<SpotAgreement> agreeingMotion(std::span<const SpotPair> pairs, double tolerance_mm,
                                            const Task& task);

}  // namespace gyre
