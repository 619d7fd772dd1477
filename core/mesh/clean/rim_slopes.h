// How steep a measured underside is where its measured part ends.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/kd_tree.h"
#include "core/scan/mesh.h"

namespace gyre {

// Reading is safe from any thread.
class RimSlopes {
 public:
  // From the vertices that cameras saw and whose surface looks down, without these triangles.
  RimSlopes(const Mesh& mesh, std::span<const std::uint32_t> guessed);

  // dz/dx and dz/dy of the parabola that fits those near the place best. Nothing where too few of
  // the measured vertices nearby look down, for that is a wall or a leg, or where the surface is
  // steeper than can be followed downwards.
  std::optional<Eigen::Vector2d> at(const Eigen::Vector3d& place, double reach_mm) const;

 private:
  std::vector<Eigen::Vector3d> places_;  // of measured vertices, mm
  std::vector<char> looks_down_;         // of each
  std::optional<KdTree> tree_;
};

}  // namespace gyre
