// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/implicit_mesh.h"

#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/sim/implicit.h"

namespace gyre {
namespace {

Bounds boxOfHalf(double half) {
  Bounds box;
  box.include(Eigen::Vector3d::Constant(-half));
  box.include(Eigen::Vector3d::Constant(half));
  return box;
}

double volumeOf(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_volumes +=
        mesh.vertices[a].position.dot(mesh.vertices[b].position.cross(mesh.vertices[c].position));
  }
  return six_volumes / 6.0;
}

TEST(ImplicitMesh, SphereHasItsRadiusVolumeAndOutwardNormals) {
  const auto ball = [](const Eigen::Vector3d& p) { return p.norm() - 10.0; };
  const Mesh mesh = meshOfImplicit(ball, boxOfHalf(11.0), 0.5);
  for (const MeshVertex& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.position.norm(), 10.0, 5e-4);
    EXPECT_GT(vertex.normal.dot(vertex.position), 9.9);
  }
  // Flat triangles in a ball lose about (cell / radius)^2 / 4 of its volume.
  EXPECT_NEAR(volumeOf(mesh), 4.0 / 3.0 * std::numbers::pi * 1000.0, 8.0);
}

TEST(ImplicitMesh, EllipsoidMeetsItsAxes) {
  const auto egg = [](const Eigen::Vector3d& p) {
    return implicit::ellipsoid(p, Eigen::Vector3d::Zero(), {4.0, 6.0, 9.0});
  };
  const Bounds bounds = boundsOf(meshOfImplicit(egg, boxOfHalf(10.0), 0.3));
  EXPECT_NEAR((bounds.max - Eigen::Vector3d(4.0, 6.0, 9.0)).norm(), 0.0, 0.02);
}

TEST(ImplicitMesh, NothingInTheBoxGivesNoMesh) {
  const auto nothing = [](const Eigen::Vector3d&) { return 1e3; };
  EXPECT_TRUE(meshOfImplicit(nothing, boxOfHalf(5.0), 1.0).triangles.empty());
}

}  // namespace
}  // namespace gyre
