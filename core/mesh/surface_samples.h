// Spreads points evenly over a surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/scan/mesh.h"

namespace gyre {

// A place on a surface and how many views saw it there, blended between the corners.
struct SurfaceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // mm
  double views = 0.0;
};

// `count` places, uniform by area: every equal share of the area gets its one place, at random
// within it; the same places for the same mesh. A mesh without triangles gives its vertices as they
// are. Nothing when all triangles are without area.
std::vector<SurfaceSample> sampleSurface(const Mesh& mesh, std::size_t count);

}  // namespace gyre
