// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/rim_slopes.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

// A square of 20 mm that looks down, without x > 0: there it was not seen.
Mesh undersideOf(const std::function<double(double, double)>& height, double noise_mm = 0.0) {
  constexpr int kCells = 40;
  Mesh mesh;
  Random random(7);
  for (int row = 0; row <= kCells; ++row) {
    for (int column = 0; column <= kCells; ++column) {
      const double x = 0.5 * column - 20.0;
      const double y = 0.5 * row - 10.0;
      MeshVertex vertex;
      vertex.position = {x, y, height(x, y) + noise_mm * random.gaussian()};
      mesh.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t row = 0; row < kCells; ++row) {
    for (std::uint32_t column = 0; column < kCells; ++column) {
      const std::uint32_t a = row * (kCells + 1) + column;
      mesh.triangles.push_back({a, a + kCells + 1, a + 1});
      mesh.triangles.push_back({a + 1, a + kCells + 1, a + kCells + 2});
    }
  }
  return mesh;
}

double round(double x, double y) { return 30.0 - std::sqrt(900.0 - x * x - y * y); }

TEST(RimSlopes, FindTheSlopeOfAPlaneAndOfABall) {
  const RimSlopes plane(undersideOf([](double x, double y) { return 5.0 + 0.4 * x - 0.2 * y; }),
                        {});
  const auto slope = plane.at({0.0, 1.0, 4.8}, 3.0);
  ASSERT_TRUE(slope);
  EXPECT_LT((*slope - Eigen::Vector2d(0.4, -0.2)).norm(), 1e-9);
  const RimSlopes ball(undersideOf([](double x, double y) { return round(x - 12.0, y); }), {});
  const auto at_rim = ball.at({0.0, 0.0, round(-12.0, 0.0)}, 3.0);
  ASSERT_TRUE(at_rim);
  EXPECT_NEAR(at_rim->x(), -12.0 / std::sqrt(900.0 - 144.0), 0.01);
  EXPECT_NEAR(at_rim->y(), 0.0, 0.01);
}

TEST(RimSlopes, BearNoise) {
  const RimSlopes plane(undersideOf([](double x, double /*y*/) { return 5.0 + 0.4 * x; }, 0.03),
                        {});
  const auto slope = plane.at({0.0, 0.0, 5.0}, 3.0);
  ASSERT_TRUE(slope);
  EXPECT_LT((*slope - Eigen::Vector2d(0.4, 0.0)).norm(), 0.1);
}

TEST(RimSlopes, KnowNothingOfWallsOfWhatLooksUpOrOfEmptySpace) {
  const auto flat = [](double /*x*/, double /*y*/) { return 5.0; };
  Mesh upwards = undersideOf(flat);
  for (Triangle& triangle : upwards.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_FALSE(RimSlopes(upwards, {}).at({0.0, 0.0, 5.0}, 3.0));
  const RimSlopes wall(undersideOf([](double x, double /*y*/) { return 5.0 - 9.0 * x; }), {});
  EXPECT_FALSE(wall.at({0.0, 0.0, 5.0}, 3.0));
  EXPECT_FALSE(RimSlopes(undersideOf(flat), {}).at({40.0, 0.0, 5.0}, 3.0));
  EXPECT_FALSE(RimSlopes(Mesh{}, {}).at({0.0, 0.0, 5.0}, 3.0));
}

TEST(RimSlopes, DoNotAskWhatIsGuessedOrUnseen) {
  Mesh mesh = undersideOf([](double x, double /*y*/) { return x < -1.0 ? 5.0 + 0.4 * x : 9.0; });
  std::vector<std::uint32_t> guessed;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.vertices[mesh.triangles[t][0]].position.x() > -2.0) guessed.push_back(t);
  }
  for (MeshVertex& vertex : mesh.vertices) vertex.seen = vertex.position.x() < -1.0 ? 1 : 0;
  const auto slope = RimSlopes(mesh, guessed).at({-1.5, 0.0, 4.4}, 3.0);
  ASSERT_TRUE(slope);
  EXPECT_LT((*slope - Eigen::Vector2d(0.4, 0.0)).norm(), 1e-6);
}

}  // namespace
}  // namespace gyre
