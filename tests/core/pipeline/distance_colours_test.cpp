// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/distance_colours.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace gyre {
namespace {

// CIE 1976 lightness of an sRGB colour.
double lightness(const Rgb& rgb) {
  const auto linear = [](std::uint8_t value) {
    const double share = value / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(DistanceColours, GrowLighterEvenly) {
  const auto& colours = distanceColours();
  const double from = lightness(colours.front());
  const double to = lightness(colours.back());
  EXPECT_GT(to - from, 60.0);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double even = from + (to - from) * static_cast<double>(i) / 255.0;
    // Rounding to 8 bits and the map's own bend; a rainbow is off by 30 and more.
    EXPECT_NEAR(lightness(colours[i]), even, 4.0) << i;
  }
}

TEST(DistanceColours, EndWhereTheScaleEnds) {
  EXPECT_EQ(distanceColour(0.0, 0.5), distanceColours().front());
  EXPECT_EQ(distanceColour(0.5, 0.5), distanceColours().back());
  EXPECT_EQ(distanceColour(7.0, 0.5), distanceColours().back());
  EXPECT_EQ(distanceColour(0.25, 0.5), distanceColours()[127]);
  EXPECT_EQ(distanceColour(std::numeric_limits<double>::quiet_NaN(), 0.5), (Rgb{128, 128, 128}));
  Mesh mesh;
  mesh.vertices.resize(2);
  colourByDistance(mesh, std::vector<double>{0.0, 1.0}, 1.0);
  EXPECT_EQ(mesh.vertices[0].rgb, distanceColours().front());
  EXPECT_EQ(mesh.vertices[1].rgb, distanceColours().back());
}

}  // namespace
}  // namespace gyre
