// A triangle mesh in the table frame.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/scan/point_cloud.h"

namespace gyre {

struct MeshVertex {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // unit, outward; zero when unknown
  Rgb rgb{};
  float sigma_mm = 0.0F;    // 0 when unknown
  std::uint16_t views = 0;  // how many views saw it
  std::uint8_t seen = 1;    // 0 when no camera saw it
};

using Triangle = std::array<std::uint32_t, 3>;  // vertex indices, counter-clockwise from outside

struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
};
using MeshPtr = std::shared_ptr<const Mesh>;

Bounds boundsOf(const Mesh& mesh);

// Sets every vertex normal to the area-weighted mean of its triangles' normals.
void computeNormals(Mesh& mesh);

}  // namespace gyre
