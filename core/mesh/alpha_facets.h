// The outer facets of a 3D alpha shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/mesh.h"

namespace gyre {

// A triangle of the alpha shape that the outside touches.
struct AlphaFacet {
  Triangle corners{};       // indices of points, counter-clockwise seen from the outside
  double radius_mm = 0.0;   // of the triangle's circumscribed circle
  bool both_sides = false;  // the outside touches it from behind as well: a sheet
};

// For each radius alpha, the facets of the alpha shape (general mode) of the points, as far as a
// ball of that radius that comes from infinity and avoids the points touches them: walls of hollows
// that it cannot enter are left out. One triangulation serves all radii. Points are distinct and
// finite. Fails with fewer than four points, or when all lie in a plane. Edelsbrunner and Muecke,
// "Three-dimensional alpha shapes" (1994).
Result<std::vector<std::vector<AlphaFacet>>> outerAlphaFacets(
    const std::vector<Eigen::Vector3d>& points, std::span<const double> alphas_mm);

}  // namespace gyre
