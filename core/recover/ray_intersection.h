// Finds a 3-D point from the rays along which several views saw it: the paper's closed forms.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "core/geometry/ray.h"

namespace gyre {

// The middle of the shortest link between two rays, in the rays' frame [mm].
//
// Returns nothing when the angle between them is below min_parallax_rad, or when the rays come
// nearest behind an origin. Leow et al., "Rapid 3D Model Acquisition from Images of Small Objects"
// (2000), eq. 8, taken at the middle instead of on the first ray.
std::optional<Eigen::Vector3d> intersectTwoRays(const Ray& first, const Ray& second,
                                                double min_parallax_rad = 0.035);

// The point nearest to all rays in the least-squares sense, in the rays' frame [mm].
//
// Returns nothing when fewer than two rays are given or all are nearly parallel: bad tracks are
// common and are not an error. Leow et al. (2000), eq. 9, squared reading, in closed form.
std::optional<Eigen::Vector3d> intersectRays(std::span<const Ray> rays);

// The point whose distances to all rays sum to the least, in the rays' frame [mm].
//
// Weiszfeld's iteration on intersectRays(): each ray weighs as much as it is near. A few wild rays
// move it little. Nothing as there. Leow et al. (2000), eq. 9, absolute reading.
std::optional<Eigen::Vector3d> intersectRaysAbsolute(std::span<const Ray> rays);

// The widest angle between any ray and the first or the last one. [rad]
double widestAngle(std::span<const Ray> rays);

}  // namespace gyre
