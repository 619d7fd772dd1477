// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/smooth.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 20.0;

Mesh noisyBall(double sigma_mm) {
  Mesh ball = test::ballMesh(kRadius_mm, 96);
  Random random(7);
  for (MeshVertex& vertex : ball.vertices) {
    vertex.position *= 1.0 + sigma_mm * random.gaussian() / kRadius_mm;
    vertex.sigma_mm = static_cast<float>(sigma_mm);
  }
  return ball;
}

double rmsError_mm(const Mesh& mesh) {
  double sum = 0.0;
  for (const MeshVertex& vertex : mesh.vertices) {
    sum += std::pow(vertex.position.norm() - kRadius_mm, 2);
  }
  return std::sqrt(sum / static_cast<double>(mesh.vertices.size()));
}

double largestMove_mm(const Mesh& a, const Mesh& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    largest = std::max(largest, (a.vertices[v].position - b.vertices[v].position).norm());
  }
  return largest;
}

TEST(SmoothMesh, TakesNoiseOffABallWithoutShrinkingIt) {
  const Mesh noisy = noisyBall(0.1);
  const auto smoothed = smoothMesh(noisy, {.iterations = 10, .max_sigmas = 3.0}, {});
  ASSERT_TRUE(smoothed);
  EXPECT_LT(rmsError_mm(smoothed->mesh), 0.6 * rmsError_mm(noisy));
  const double true_mm3 = meshHealth(test::ballMesh(kRadius_mm, 96)).volume_mm3;
  EXPECT_NEAR(meshHealth(smoothed->mesh).volume_mm3 / true_mm3, 1.0, 0.003);
}

TEST(SmoothMesh, MovesNoVertexFartherThanItsSigmaAllows) {
  Mesh noisy = noisyBall(0.3);
  for (std::size_t v = 0; v < noisy.vertices.size(); ++v) {
    noisy.vertices[v].sigma_mm = 0.01F * static_cast<float>(1 + v % 5);
  }
  const auto smoothed = smoothMesh(noisy, {.iterations = 20, .max_sigmas = 2.0}, {});
  ASSERT_TRUE(smoothed);
  for (std::size_t v = 0; v < noisy.vertices.size(); ++v) {
    EXPECT_LE((smoothed->mesh.vertices[v].position - noisy.vertices[v].position).norm(),
              2.0 * static_cast<double>(noisy.vertices[v].sigma_mm) + 1e-12);
  }
  EXPECT_NEAR(smoothed->largest_move_mm, largestMove_mm(noisy, smoothed->mesh), 1e-12);
  EXPECT_GT(smoothed->at_bound_share, 0.5);
}

TEST(SmoothMesh, BoundsVerticesOfUnknownAccuracyByTheMeanEdge) {
  Mesh noisy = noisyBall(0.3);
  for (MeshVertex& vertex : noisy.vertices) vertex.sigma_mm = 0.0F;
  const auto smoothed = smoothMesh(noisy, {.iterations = 20, .max_edge_share = 0.05}, {});
  ASSERT_TRUE(smoothed);
  EXPECT_GT(smoothed->largest_move_mm, 0.0);
  EXPECT_LT(smoothed->largest_move_mm, 0.05 * 1.4);  // the mean edge is shorter
}

TEST(SmoothMesh, KeepsAFlatSheetFlatAndItsRimStraight) {
  Mesh sheet = test::squareMesh(10.0, 3.0);
  for (MeshVertex& vertex : sheet.vertices) vertex.sigma_mm = 1.0F;
  const auto smoothed = smoothMesh(sheet, {.iterations = 2}, {});
  ASSERT_TRUE(smoothed);
  for (std::size_t v = 0; v < sheet.vertices.size(); ++v) {
    const Eigen::Vector3d before = sheet.vertices[v].position;
    const Eigen::Vector3d after = smoothed->mesh.vertices[v].position;
    EXPECT_NEAR(after.z(), 3.0, 1e-12);
    const bool far_from_corners = std::abs(before.y()) < 0.5;
    if (before.x() == 5.0 && far_from_corners) {
      EXPECT_NEAR(after.x(), 5.0, 1e-12);
    }
  }
}

TEST(SmoothMesh, HoldsTheHeightOfTheBase) {
  Mesh noisy = noisyBall(0.1);
  for (MeshVertex& vertex : noisy.vertices) {
    if (vertex.position.z() < -15.0) vertex.position.z() = -15.0;
  }
  const auto smoothed =
      smoothMesh(noisy, {.iterations = 10, .max_sigmas = 3.0, .hold_z_mm = -15.0}, {});
  ASSERT_TRUE(smoothed);
  for (std::size_t v = 0; v < noisy.vertices.size(); ++v) {
    if (noisy.vertices[v].position.z() == -15.0) {
      EXPECT_EQ(smoothed->mesh.vertices[v].position.z(), -15.0);
    }
  }
}

TEST(SmoothMesh, KeepsAttributesAndInput) {
  Mesh noisy = noisyBall(0.1);
  noisy.vertices[5].rgb = {1, 2, 3};
  noisy.vertices[5].views = 9;
  noisy.vertices[6].seen = 0;
  const Mesh before = noisy;
  const auto smoothed = smoothMesh(noisy, {.iterations = 3}, {});
  ASSERT_TRUE(smoothed);
  EXPECT_EQ(smoothed->mesh.vertices[5].rgb[2], 3);
  EXPECT_EQ(smoothed->mesh.vertices[5].views, 9);
  EXPECT_EQ(smoothed->mesh.vertices[6].seen, 0);
  EXPECT_EQ(largestMove_mm(noisy, before), 0.0);
}

TEST(SmoothMesh, LeavesAloneRefusesAndStops) {
  Mesh one = test::tetrahedronMesh({0, 0, 0}, 1.0);
  one.triangles.resize(1);
  EXPECT_EQ(smoothMesh(one, {}, {})->largest_move_mm, 0.0);
  EXPECT_TRUE(smoothMesh(one, {.iterations = 5}, {}));
  EXPECT_EQ(smoothMesh(Mesh{}, {.iterations = 5}, {}).error().code, Error::Code::kTooFew);
  EXPECT_EQ(smoothMesh(one, {.iterations = -1}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(smoothMesh(one, {.iterations = 5}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
