// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/rigid_alignment.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

Mesh waves() {
  return test::gridMesh(41, 41, [](double u, double v) {
    return Eigen::Vector3d(20 * u, 30 * v, 6 * std::sin(5 * u) * std::cos(4 * v));
  });
}

Rigid3 smallMotion() {
  Rigid3 motion;
  motion.rotation =
      Eigen::AngleAxisd(0.1, Eigen::Vector3d(2, -1, 3).normalized()).toRotationMatrix();
  motion.translation = {0.6, -0.3, 0.5};
  return motion;
}

double largestMiss(const Mesh& mesh, const Rigid3& motion) {
  double miss_mm = 0.0;
  for (const MeshVertex& vertex : mesh.vertices) {
    miss_mm = std::max(miss_mm, (motion * vertex.position - vertex.position).norm());
  }
  return miss_mm;
}

TEST(AlignRigidly, UndoesASmallMotion) {
  const Mesh reference = waves();
  Mesh result = reference;
  for (MeshVertex& vertex : result.vertices) vertex.position = smallMotion() * vertex.position;
  const auto back = alignRigidly(result, reference, {});
  ASSERT_TRUE(back);
  EXPECT_TRUE(isRigid(*back, 1e-9));
  EXPECT_LT(largestMiss(reference, *back * smallMotion()), 0.02);  // chords of differing samples
}

TEST(AlignRigidly, UndoesItBetweenNoisyPoints) {
  const Mesh reference = waves();
  Mesh result = reference;
  result.triangles.clear();
  Random random(4);
  for (MeshVertex& vertex : result.vertices) {
    vertex.position =
        smallMotion() * vertex.position +
        0.05 * Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
  }
  const auto back = alignRigidly(result, reference, {});
  ASSERT_TRUE(back);
  EXPECT_LT(largestMiss(reference, *back * smallMotion()), 0.05);
}

TEST(AlignRigidly, LeavesASphereUnturned) {
  const auto motion = alignRigidly(test::sphereMesh(10.0, {0.5, 0, 0}), test::sphereMesh(10.0), {});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->translation.x(), -0.5, 0.01);
  EXPECT_LT((motion->rotation - Eigen::Matrix3d::Identity()).norm(), 0.02);
}

TEST(AlignRigidly, RefusesSinglePoints) {
  Mesh points = test::squareMesh(10.0, 0.0);
  points.triangles.clear();
  points.vertices.resize(2);
  EXPECT_EQ(alignRigidly(points, waves(), {}).error().code, Error::Code::kTooFew);
}

}  // namespace
}  // namespace gyre
