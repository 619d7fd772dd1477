// Reads models by assimp, which knows nothing of Gyre: what other programs make of our files.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "core/scan/mesh.h"

namespace gyre::test {

struct ForeignCorner {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();        // in the file's unit
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();          // zero when the file has none
  Eigen::Vector3d colour = Eigen::Vector3d::Constant(-1.0);  // 0..1 as in the file; -1: none
};
using ForeignTriangle = std::array<ForeignCorner, 3>;

struct ForeignModel {
  std::vector<ForeignTriangle> triangles;  // in the file's order
  Bounds bounds;                           // of the triangles
};

// Empty when assimp cannot read the file.
ForeignModel readByAssimp(const std::filesystem::path& file);

// An egg of 24 mm that hovers 0.4 mm above the platter and is off the axis, its base unseen, each
// vertex of another colour; with a vertex and a triangle that are nothing to see.
Mesh hoveringEgg();

}  // namespace gyre::test
