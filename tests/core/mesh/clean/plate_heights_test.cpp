// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/plate_heights.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

struct Shape {
  std::function<double(double, double)> height;
  std::function<Eigen::Vector2d(double, double)> slope;
};

const Shape kTilted{[](double x, double y) { return 0.3 * x - 0.7 * y + 2.0; },
                    [](double, double) { return Eigen::Vector2d(0.3, -0.7); }};
const Shape kBowl{[](double x, double y) { return 0.04 * (x * x + y * y); },
                  [](double x, double y) { return Eigen::Vector2d(0.08 * x, 0.08 * y); }};
const Shape kSaddle{
    [](double x, double y) { return 0.05 * x * y - 0.02 * x * x; },
    [](double x, double y) { return Eigen::Vector2d(0.05 * y - 0.04 * x, 0.05 * x); }};
// Biharmonic and not harmonic, of third degree.
const Shape kTwist{[](double x, double y) { return 0.004 * x * (x * x + y * y); },
                   [](double x, double y) {
                     return Eigen::Vector2d(0.004 * (3.0 * x * x + y * y), 0.008 * x * y);
                   }};

// A disc of 10 mm: rings of triangles, shifted a little, the shape at its rim and nothing within.
Plate discOf(const Shape& shape, int rings, double shift = 0.0) {
  Plate plate;
  Random random(5);
  plate.places.emplace_back(0.0, 0.0, 99.0);
  const auto first = [](int ring) { return static_cast<std::uint32_t>(1 + 3 * ring * (ring - 1)); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double turn = 2.0 * 3.14159265358979 * i / (6.0 * ring);
      Eigen::Vector2d at = 10.0 * ring / rings * Eigen::Vector2d(std::cos(turn), std::sin(turn));
      const bool at_rim = ring == rings;
      if (!at_rim)
        at += 10.0 / rings * shift * Eigen::Vector2d(random.gaussian(), random.gaussian());
      plate.places.emplace_back(at.x(), at.y(), at_rim ? shape.height(at.x(), at.y()) : 99.0);
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    for (int side = 0; side < 6; ++side) {
      for (int i = 0; i < ring; ++i) {
        const auto outer = [&](int k) {
          return first(ring) + static_cast<std::uint32_t>((side * ring + k) % (6 * ring));
        };
        const auto inner = [&](int k) {
          if (ring == 1) return 0U;
          return first(ring - 1) +
                 static_cast<std::uint32_t>((side * (ring - 1) + k) % (6 * (ring - 1)));
        };
        plate.triangles.push_back({outer(i), outer(i + 1), inner(i)});
        if (i + 1 < ring) plate.triangles.push_back({inner(i), outer(i + 1), inner(i + 1)});
      }
    }
  }
  plate.held.assign(plate.places.size(), 0);
  plate.slopes.resize(plate.places.size());
  for (std::uint32_t i = first(rings); i < plate.places.size(); ++i) {
    plate.held[i] = 1;
    plate.slopes[i] = shape.slope(plate.places[i].x(), plate.places[i].y());
  }
  return plate;
}

double farthestFrom(const Shape& shape, const Plate& plate, const std::vector<double>& heights) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    farthest = std::max(
        farthest, std::abs(heights[i] - shape.height(plate.places[i].x(), plate.places[i].y())));
  }
  return farthest;
}

TEST(PlateHeights, FollowPlanesExactly) {
  const Plate plate = discOf(kTilted, 8, 0.15);
  const auto heights = plateHeights(plate);
  ASSERT_TRUE(heights);
  EXPECT_LT(farthestFrom(kTilted, plate, *heights), 1e-9);
}

TEST(PlateHeights, FollowBiharmonicShapes) {
  for (const Shape* shape : {&kBowl, &kSaddle, &kTwist}) {
    const Plate plate = discOf(*shape, 16, 0.1);
    const auto heights = plateHeights(plate);
    ASSERT_TRUE(heights);
    EXPECT_LT(farthestFrom(*shape, plate, *heights), 0.06);  // of 4 mm
  }
}

TEST(PlateHeights, ComeNearerWithSmallerTriangles) {
  const Plate coarse = discOf(kTwist, 6);
  const Plate fine = discOf(kTwist, 24);
  EXPECT_LT(farthestFrom(kTwist, fine, *plateHeights(fine)),
            0.3 * farthestFrom(kTwist, coarse, *plateHeights(coarse)));
}

TEST(PlateHeights, AreFlatWhereTheRimIsFlatAndNoSlopeIsKnown) {
  Plate plate = discOf(kTilted, 8, 0.1);
  for (auto& slope : plate.slopes) slope.reset();
  const auto heights = plateHeights(plate);
  ASSERT_TRUE(heights);
  EXPECT_LT(farthestFrom(kTilted, plate, *heights), 1e-9);
}

TEST(PlateHeights, KeepWhatIsHeldWithin) {
  Plate plate = discOf(kBowl, 10);
  plate.held[0] = 1;
  plate.places[0].z() = -3.0;
  const auto heights = plateHeights(plate);
  ASSERT_TRUE(heights);
  EXPECT_EQ(heights->front(), -3.0);
  EXPECT_LT((*heights)[1], 0.0);
}

TEST(PlateHeights, BearSlivers) {
  Plate plate = discOf(kBowl, 12);
  // The middle moves so near to a neighbour that two triangles have hardly any area.
  plate.places[0].head<2>() = 0.999 * plate.places[1].head<2>();
  const auto heights = plateHeights(plate);
  ASSERT_TRUE(heights);
  EXPECT_LT(farthestFrom(kBowl, plate, *heights), 0.2);
}

TEST(PlateHeights, HaveNoAnswerWhereNothingHoldsThem) {
  Plate plate = discOf(kTilted, 3);
  plate.held.assign(plate.held.size(), 0);
  for (auto& slope : plate.slopes) slope.reset();
  const auto heights = plateHeights(plate);
  EXPECT_TRUE(!heights || std::abs(heights->front()) < 1e9);
}

}  // namespace
}  // namespace gyre
