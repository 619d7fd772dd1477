// The simulated objects by formula: where their surface is and how they are painted.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/sim/implicit_mesh.h"

namespace gyre {

// One object in a frame of its own: it stands on z = 0 and faces +x; lengths are only relative.
struct ObjectModel {
  SignedDistance distance;  // empty for the cube, whose mesh is exact (objects.cpp)
  Bounds box;               // holds the object
  // Ground colour there, RGB in [0, 1], before the texture.
  std::function<Eigen::Vector3f(const Eigen::Vector3d&)> paint;
  double texture = 1.0;  // 1 = richly textured, 0 = one colour
};

// duck, mouse, cube, vase, bowl, plate, plain.
const std::vector<std::string>& objectNames();

// The name must be one of objectNames().
ObjectModel objectModel(const std::string& name);

}  // namespace gyre
