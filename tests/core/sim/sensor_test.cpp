// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sensor.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gyre {
namespace {

LightImage evenLight(float value) {
  LightImage light(200, 150);
  for (float& each : light.bgr) each = value;
  return light;
}

TEST(Sensor, NoiseHasItsSigmaAndNoBias) {
  const Frame frame = Sensor(0.8, 2.0).expose(evenLight(0.5F), 7);
  double sum = 0.0;
  double squares = 0.0;
  const double n = 3.0 * 200.0 * 150.0;
  for (int y = 0; y < 150; ++y) {
    const auto* row = frame.image_bgr.ptr<std::uint8_t>(y);
    for (int i = 0; i < 600; ++i) {
      sum += row[i];
      squares += static_cast<double>(row[i]) * row[i];
    }
  }
  EXPECT_NEAR(sum / n, 127.5, 0.05);
  // Rounding to whole levels adds a variance of 1/12.
  EXPECT_NEAR(std::sqrt(squares / n - (sum / n) * (sum / n)), std::sqrt(4.0 + 1.0 / 12.0), 0.03);
}

TEST(Sensor, BlurOfAPointIsAGaussianOfItsSigma) {
  LightImage light(41, 41);
  light.row(20)[3 * 20] = 3.0F;
  const Frame frame = Sensor(0.8, 0.0).expose(light, 1);
  const auto level = [&](int y, int x) {
    return static_cast<double>(frame.image_bgr.ptr<std::uint8_t>(y)[3 * x]);
  };
  const double peak = 3.0 * 255.0 / (2.0 * M_PI * 0.64);
  EXPECT_NEAR(level(20, 20), peak, 1.0);
  EXPECT_NEAR(level(20, 21), peak * std::exp(-0.5 / 0.64), 1.0);
  EXPECT_NEAR(level(21, 21), peak * std::exp(-1.0 / 0.64), 1.0);
  EXPECT_EQ(level(20, 20 + 6), 0.0);
}

TEST(Sensor, WithoutBlurAndNoiseKeepsPixelsAndClips) {
  LightImage light(5, 4);
  light.row(0)[0] = 0.2F;
  light.row(3)[14] = 2.0F;
  light.row(2)[3] = -1.0F;
  const Frame frame = Sensor(0.0, 0.0).expose(light, 1);
  EXPECT_EQ(frame.image_bgr.ptr<std::uint8_t>(0)[0], 51);
  EXPECT_EQ(frame.image_bgr.ptr<std::uint8_t>(3)[14], 255);
  EXPECT_EQ(frame.image_bgr.ptr<std::uint8_t>(2)[3], 0);
}

TEST(Sensor, PictureNarrowerThanTheBlurIsStillEven) {
  LightImage light(2, 2);
  for (float& each : light.bgr) each = 0.4F;
  const Frame frame = Sensor(2.0, 0.0).expose(light, 1);
  EXPECT_EQ(frame.image_bgr.ptr<std::uint8_t>(1)[5], 102);
}

}  // namespace
}  // namespace gyre
