// The heights of a thin plate that is held and led at its rim.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/scan/mesh.h"

namespace gyre {

// A surface over the plane x, y whose triangles do not overlap there.
struct Plate {
  std::vector<Eigen::Vector3d> places;  // mm
  std::vector<Triangle> triangles;      // either way round
  std::vector<char> held;               // of each place: its height stays; all at the rim do
  // Of each place at the rim, where it is known: dz/dx and dz/dy of the surface beyond.
  std::vector<std::optional<Eigen::Vector2d>> slopes;
};

// The height of every place, in mm, at which the plate bends least: the sum of the squared
// Laplacian is smallest, with the slopes given across the rim and none asked where they are not
// known. Biharmonic functions come out exactly but for the triangles' size. By linear elements on
// height and Laplacian (Ciarlet and Raviart, "A mixed finite element method for the biharmonic
// equation", 1974), so that small and large triangles may meet. Nothing when that has no single
// answer, such as where a part of the plate is held nowhere. Any thread.
std::optional<std::vector<double>> plateHeights(const Plate& plate);

}  // namespace gyre
