// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/background.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gyre {
namespace {

Ray fromCameraTo(const Eigen::Vector3d& target) {
  const Eigen::Vector3d camera = trueCalibration({}).cam_from_table->inverse().translation;
  return {camera, (target - camera).normalized()};
}

TEST(Background, HasTexture) {
  const Background background{RigSettings{}};
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (double y = -100.0; y <= 100.0; y += 1.7) {
    for (double x = -250.0; x <= -90.0; x += 1.7) {
      const auto light = static_cast<double>(background.radiance(fromCameraTo({x, y, -25.0})).y());
      ASSERT_GE(light, 0.0);
      ASSERT_LE(light, 1.0);
      sum += light;
      squares += light * light;
      ++count;
    }
  }
  const double mean = sum / count;
  EXPECT_GT(mean, 0.1);
  EXPECT_GT(std::sqrt(squares / count - mean * mean), 0.05);
}

TEST(Background, IsTheSameForTheSameSeedOnly) {
  RigSettings other;
  other.seed = 2;
  const Background first{RigSettings{}};
  const Background second{RigSettings{}};
  const Background third(other);
  const Ray ray = fromCameraTo({-150.0, 20.0, -25.0});
  EXPECT_EQ(first.radiance(ray), second.radiance(ray));
  EXPECT_NE(first.radiance(ray), third.radiance(ray));
}

TEST(Background, PlatterHasADarkSideInFront) {
  const Background background{RigSettings{}};
  const float side = background.radiance(fromCameraTo({70.0, 0.0, -3.0})).maxCoeff();
  EXPECT_LT(side, 0.2F);
}

TEST(Background, RaysUpwardsEndAtAFarWall) {
  const Background background{RigSettings{}};
  const Eigen::Vector3f light =
      background.radiance({{300.0, 0.0, 200.0}, Eigen::Vector3d(-1.0, 0.0, 0.5).normalized()});
  EXPECT_TRUE(light.allFinite());
}

}  // namespace
}  // namespace gyre
