// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/visibility_cut.h"

#include <stop_token>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"
#include "tests/support/seen_bodies.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

using ::testing::HasSubstr;

void expectTheBody(const test::Body& body, double noise_share) {
  const auto seen = test::seenBody(body, noise_share, 7);
  const auto cut = visibilityCut(seen.cloud, seen.sights, {}, {});
  ASSERT_TRUE(cut) << cut.error().sentence();
  const MeshHealth health = meshHealth(cut->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(health.non_manifold_vertices, 0U);
  EXPECT_EQ(health.components, 1U);
  EXPECT_EQ(health.euler_number, body.euler_number);
  EXPECT_GT(health.volume_mm3, 0.0);
  EXPECT_LT(test::errorInSpacings(cut->mesh, body, 0.95), 1.0);
}

TEST(VisibilityCut, KeepsASphereWithAnyNoise) {
  for (const double noise_share : {0.0, 0.1, 0.3}) expectTheBody(test::sphereBody(), noise_share);
}

TEST(VisibilityCut, KeepsTheHoleOfATorus) {
  for (const double noise_share : {0.0, 0.3}) expectTheBody(test::torusBody(), noise_share);
}

TEST(VisibilityCut, KeepsAPlateOfTwoSpacings) {
  for (const double noise_share : {0.0, 0.1}) expectTheBody(test::plateBody(), noise_share);
}

TEST(VisibilityCut, KeepsACube) {
  for (const double noise_share : {0.0, 0.1}) expectTheBody(test::cubeBody(), noise_share);
}

// Half a sphere, seen from above only, over what no camera sees.
struct Dome {
  PointCloud cloud;
  SightEvidence sights;
};
Dome dome() {
  Dome dome;
  for (std::size_t i = 0; i < 12; ++i) {
    dome.sights.camera_centres.push_back({300.0 * std::cos(static_cast<double>(i)),
                                          300.0 * std::sin(static_cast<double>(i)), 150.0});
  }
  for (Point point : test::sphereCloud(6000, 20.0).points) {
    if (point.position.z() < 0.5) continue;
    for (std::uint32_t view = 0; view < 12; ++view) {
      const auto towards = dome.sights.camera_centres[view] - point.position;
      if (towards.normalized().dot(point.normal) > 0.3) point.views.push_back(view);
    }
    if (!point.views.empty()) dome.cloud.points.push_back(std::move(point));
  }
  return dome;
}

TEST(VisibilityCut, ClosesAnUnseenBaseFlatOnTheTableAndSaysWhatWasNotSeen) {
  const Dome seen = dome();
  const auto cut = visibilityCut(seen.cloud, seen.sights, {}, {});
  ASSERT_TRUE(cut);
  const MeshHealth health = meshHealth(cut->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_EQ(health.euler_number, 2);
  EXPECT_EQ(boundsOf(cut->mesh).min.z(), 0.0);
  EXPECT_NEAR(health.volume_mm3, 2.0 / 3.0 * kPi * 8000.0, 0.02 * 16755.0);
  EXPECT_NEAR(health.unseen_area_mm2, kPi * 400.0, 0.1 * kPi * 400.0);
}

TEST(VisibilityCut, CutsAwayWhatTheBackgroundShows) {
  // Two balls apart, joined by whatever stands between them until pictures show that nothing does.
  Dome two = dome();
  const std::size_t count = two.cloud.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    Point moved = two.cloud.points[i];
    moved.position.x() += 60.0;
    two.cloud.points.push_back(moved);
  }
  const auto joined = visibilityCut(two.cloud, two.sights, {.min_component_share = 0.0}, {});
  ASSERT_TRUE(joined);
  EXPECT_EQ(meshHealth(joined->mesh).components, 1U);
  for (const Eigen::Vector3d& camera :
       {Eigen::Vector3d(30.0, -250.0, 60.0), Eigen::Vector3d(30.0, 250.0, 60.0),
        Eigen::Vector3d(30.0, -100.0, 250.0)}) {
    auto& rays = two.sights.background.emplace_back();
    for (double x = 24.0; x < 36.0; x += 0.25) {
      for (double y = -19.0; y < 19.0; y += 0.5) {
        rays.push_back({camera, (Eigen::Vector3d(x, y, 0.0) - camera).normalized()});
      }
    }
  }
  const auto apart = visibilityCut(two.cloud, two.sights, {.min_component_share = 0.0}, {});
  ASSERT_TRUE(apart);
  EXPECT_EQ(meshHealth(apart->mesh).components, 2U);
  EXPECT_NEAR(meshHealth(apart->mesh).volume_mm3, 2.0 * 16755.0, 0.02 * 2.0 * 16755.0);
}

TEST(VisibilityCut, IsTheSameEveryTime) {
  const Dome seen = dome();
  const auto once = visibilityCut(seen.cloud, seen.sights, {}, {});
  const auto again = visibilityCut(seen.cloud, seen.sights, {}, {});
  EXPECT_EQ(once->mesh.triangles, again->mesh.triangles);
}

TEST(VisibilityCut, SaysWhatIsMissing) {
  Dome seen = dome();
  EXPECT_EQ(visibilityCut({}, seen.sights, {}, {}).error().code, Error::Code::kInvalidInput);
  EXPECT_THAT(visibilityCut(seen.cloud, {}, {}, {}).error().what, HasSubstr("which views"));
  EXPECT_EQ(visibilityCut(seen.cloud, seen.sights, {.quality = -1.0}, {}).error().code,
            Error::Code::kInvalidInput);
  for (Point& point : seen.cloud.points) point.position.z() = 1.0;
  EXPECT_FALSE(visibilityCut(seen.cloud, seen.sights, {}, {}));
}

TEST(VisibilityCut, RefusesSightsOfAnotherScan) {
  Dome seen = dome();
  for (Eigen::Vector3d& camera : seen.sights.camera_centres) camera.head<2>() *= -1.0;
  EXPECT_THAT(visibilityCut(seen.cloud, seen.sights, {}, {}).error().what, HasSubstr("look away"));
}

TEST(VisibilityCut, HearsAStop) {
  std::stop_source stop;
  stop.request_stop();
  const Dome seen = dome();
  const auto cut = visibilityCut(seen.cloud, seen.sights, {}, Task(stop.get_token()));
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
