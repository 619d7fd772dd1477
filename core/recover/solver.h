// The ways to find a point from its rays: the paper's three readings, and the robust one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include "core/geometry/ray.h"

namespace gyre {

enum class Solver {
  kTwoView,   // the closed form of two rays, those that cross most squarely (eq. 8)
  kSquared,   // least squared distances to all rays (eq. 9)
  kAbsolute,  // least distances to all rays (eq. 9, as its text says)
  kRobust,    // most likely by the reprojection errors, wrong sightings left out
};

inline constexpr const char* kSolverNames = "two-view, squared, absolute or robust";

// Nothing when it is none of the names.
std::optional<Solver> solverFromName(std::string_view name);

// The point by one of the paper's readings, in the rays' frame [mm]; every ray is believed. Nothing
// when the rays are fewer than two or nearly parallel. Leow et al. (2000), section 3.2.
std::optional<Eigen::Vector3d> intersectByPaper(Solver solver, std::span<const Ray> rays);

}  // namespace gyre
