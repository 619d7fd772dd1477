// What lattices of corners tell of the camera and of their own places before they have names.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/calib/corners/corner_lattice.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"

namespace gyre {

// The focal length at which the lattices' squares are square, for square pixels and a given
// principal point, distortion left aside. Nothing when none is tilted enough to tell. [px]
// Zhang, "A Flexible New Technique for Camera Calibration" (2000), eq. 3 and 4.
std::optional<double> focalFromLattices(std::span<const CornerLattice> lattices,
                                        std::span<const XCorner> corners,
                                        const Eigen::Vector2d& principal_px);

// The one or two poses of a lattice in front of the camera that explain its corners, the better one
// first. The lattice's frame: column along x, row along y, z away from the camera, squares of 1.
// Collins and Bartoli, "Infinitesimal Plane-Based Pose Estimation" (2014), by OpenCV.
std::vector<Rigid3> posesOfLattice(const CornerLattice& lattice, std::span<const XCorner> corners,
                                   const CameraModel& camera);

// The height of the lattice's squares in the picture, in its middle. [px]
double squareHeight_px(const CornerLattice& lattice, std::span<const XCorner> corners);

}  // namespace gyre
