// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/truth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

std::vector<std::int64_t> evenSteps(int views, int steps_per_turn) {
  std::vector<std::int64_t> steps;
  for (int i = 0; i < views; ++i) steps.push_back(std::int64_t{i} * steps_per_turn / views);
  return steps;
}

// The egg with the flat cap is convex: nothing hides but the angle at which it is met.
TEST(Truth, OnAConvexObjectViewsFollowFromTheNormalsAlone) {
  RigSettings rig = atImageWidth({}, 320);
  rig.object = "plain";
  const Renderer renderer(rig);
  const auto steps = evenSteps(40, rig.steps_per_turn);
  const auto truth = truthOf(renderer, steps, {});
  ASSERT_TRUE(truth.ok());
  EXPECT_NEAR(truth->size_mm, 80.0, 1e-6);
  const Rigid3 at_zero = *trueCalibration(rig).cam_from_table;
  int wrong = 0;
  for (const MeshVertex& vertex : truth->mesh.vertices) {
    int expected = 0;
    for (const std::int64_t step : steps) {
      const Eigen::Vector3d to_camera =
          camFromTable(at_zero, trueAngleRad(rig, step)).inverse().translation - vertex.position;
      const double angle_rad = std::acos(vertex.normal.dot(to_camera.normalized()));
      expected += angle_rad <= radFromDeg(70.0) ? 1 : 0;
    }
    wrong += expected == vertex.views ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Truth, TheBaseIsNeverSeenAndTheTopIsAlways) {
  const RigSettings rig = atImageWidth({}, 320);
  const Renderer renderer(rig);
  const auto truth = truthOf(renderer, evenSteps(24, rig.steps_per_turn), {});
  ASSERT_TRUE(truth.ok());
  for (const MeshVertex& vertex : truth->mesh.vertices) {
    if (vertex.normal.z() < -0.95) {
      ASSERT_EQ(vertex.views, 0);
    }
    ASSERT_EQ(vertex.seen != 0, vertex.views >= kViewsToBeSeen);
  }
  EXPECT_GT(seenShare(truth->mesh), 0.6);
  EXPECT_LT(seenShare(truth->mesh), 0.95);
}

TEST(Truth, TheBowlsOwnWallHidesItsInside) {
  RigSettings rig = atImageWidth({}, 320);
  rig.object = "bowl";
  const Renderer renderer(rig);
  const std::vector<std::int64_t> one = {0};
  const auto truth = truthOf(renderer, one, {});
  ASSERT_TRUE(truth.ok());
  // The camera is at +x: of the inside it sees the far wall, at -x, and not the near one.
  const Eigen::Vector2d middle = objectOffsetInTable(rig);
  int near_seen = 0;
  int far_seen = 0;
  for (const MeshVertex& vertex : truth->mesh.vertices) {
    const Eigen::Vector2d out = vertex.position.head<2>() - middle;
    const bool inside = vertex.normal.head<2>().dot(out) < -5.0;
    if (!inside) continue;
    const bool below_rim = vertex.position.z() < 20.0;
    near_seen += out.x() > 10.0 && below_rim ? vertex.views : 0;
    far_seen += out.x() < -10.0 ? vertex.views : 0;
  }
  EXPECT_GT(far_seen, 500);
  EXPECT_EQ(near_seen, 0);
}

TEST(Truth, ThePlatterHidesFromACameraBelowIt) {
  RigSettings rig = atImageWidth({}, 320);
  rig.camera_elevation_deg = -30.0;
  const Renderer renderer(rig);
  const auto truth = truthOf(renderer, evenSteps(8, rig.steps_per_turn), {});
  ASSERT_TRUE(truth.ok());
  int low_seen = 0;
  for (const MeshVertex& vertex : truth->mesh.vertices) {
    low_seen += vertex.position.z() < 5.0 ? vertex.views : 0;
  }
  EXPECT_EQ(low_seen, 0);
}

TEST(Truth, StopsWhenAsked) {
  const Renderer renderer(atImageWidth({}, 160));
  std::stop_source source;
  source.request_stop();
  const std::vector<std::int64_t> one = {0};
  const auto truth = truthOf(renderer, one, Task(source.get_token()));
  ASSERT_FALSE(truth.ok());
  EXPECT_EQ(truth.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
