// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/visibility_cut.h"

#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

TEST(VisibilityCut, OfASphereIsAClosedSphere) {
  PointCloud cloud = test::sphereCloud(4000, 20.0);
  SightEvidence evidence;
  for (std::size_t i = 0; i < 24; ++i) {
    evidence.camera_centres.push_back(300.0 * test::spiralDirection(i, 24));
  }
  for (Point& point : cloud.points) {
    for (std::uint32_t view = 0; view < 24; ++view) {
      const Eigen::Vector3d towards =
          (evidence.camera_centres[view] - point.position).normalized();
      if (towards.dot(point.normal) > 0.35) point.views.push_back(view);
    }
  }
  const auto cut = visibilityCut(cloud, evidence, {}, {});
  ASSERT_TRUE(cut) << cut.error().sentence();
  const MeshHealth health = meshHealth(cut->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(health.components, 1U);
  EXPECT_EQ(2 * health.vertices, health.triangles + 4);
  EXPECT_NEAR(health.volume_mm3, 4.0 / 3.0 * kPi * 8000.0, 0.01 * 33510.0);
}

}  // namespace
}  // namespace gyre
