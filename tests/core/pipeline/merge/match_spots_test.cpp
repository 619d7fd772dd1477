// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/match_spots.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/random.h"

namespace gyre {
namespace {

constexpr double kRadius_mm = 40.0;
constexpr double kTolerance_mm = 0.6;
constexpr int kLength = 128;

Rigid3 motion() {
  Rigid3 fixed_from_moving;
  fixed_from_moving.rotation =
      Eigen::AngleAxisd(2.7, Eigen::Vector3d(1, -3, 0.5).normalized()).toRotationMatrix();
  fixed_from_moving.translation = {3.0, -8.0, 70.0};
  return fixed_from_moving;
}

Eigen::Vector3d onBall(Random& random) {
  Eigen::Vector3d way(random.gaussian(), random.gaussian(), random.gaussian());
  return kRadius_mm * way.normalized();
}

// `good` pairs that agree but for the noise, and `bad` ones between any two places.
std::vector<SpotPair> pairsOf(int good, int bad, double noise_mm) {
  Random random(9);
  std::vector<SpotPair> pairs;
  const Rigid3 moving_from_fixed = motion().inverse();
  for (int i = 0; i < good + bad; ++i) {
    const Eigen::Vector3d fixed = onBall(random);
    const Eigen::Vector3d place = i < good ? fixed : onBall(random);
    const Eigen::Vector3d noise(random.gaussian(), random.gaussian(), random.gaussian());
    pairs.push_back({fixed, moving_from_fixed * place + noise_mm * noise, fixed / kRadius_mm,
                     moving_from_fixed.rotation * place / kRadius_mm});
  }
  return pairs;
}

double miss(const Rigid3& found) {
  double miss_mm = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d place =
        motion().inverse() * (kRadius_mm * Eigen::Vector3d::Unit(i)).eval();
    miss_mm = std::max(miss_mm, (found * place - motion() * place).norm());
  }
  return miss_mm;
}

TEST(AgreeingMotion, IsExactOnExactPairs) {
  const auto found = agreeingMotion(pairsOf(40, 0, 0.0), kTolerance_mm, {});
  ASSERT_TRUE(found);
  EXPECT_LT(miss(found->fixed_from_moving), 1e-9);
  EXPECT_EQ(found->pairs.size(), 40U);
}

TEST(AgreeingMotion, FindsTheTenthThatAgrees) {
  const auto found = agreeingMotion(pairsOf(60, 540, 0.1), kTolerance_mm, {});
  ASSERT_TRUE(found);
  // 60 pairs of 0.1 mm: about 0.1 mm sqrt(3 / 60) in each direction.
  EXPECT_LT(miss(found->fixed_from_moving), 0.08);
  EXPECT_GE(found->pairs.size(), 58U);
  EXPECT_LE(found->pairs.size(), 66U);
}

TEST(AgreeingMotion, IsNotFoundInChance) {
  EXPECT_FALSE(agreeingMotion(pairsOf(0, 2000, 0.1), kTolerance_mm, {}));
  EXPECT_FALSE(agreeingMotion(pairsOf(10, 0, 0.0), kTolerance_mm, {}));  // too few
  EXPECT_FALSE(agreeingMotion({}, kTolerance_mm, {}));
}

TEST(AgreeingMotion, IsNotFoundAlongALine) {
  std::vector<SpotPair> pairs;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d place(0.0, 0.0, i);
    pairs.push_back({place, place, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()});
  }
  EXPECT_FALSE(agreeingMotion(pairs, kTolerance_mm, {}));
}

TEST(AgreeingMotion, AsksTheNormalsToo) {
  std::vector<SpotPair> pairs = pairsOf(60, 0, 0.0);
  for (SpotPair& pair : pairs) pair.moving_normal = -pair.moving_normal;
  EXPECT_FALSE(agreeingMotion(pairs, kTolerance_mm, {}));
}

TEST(AgreeingMotion, IsTheSameEachTime) {
  const auto pairs = pairsOf(60, 200, 0.1);
  const auto once = agreeingMotion(pairs, kTolerance_mm, {});
  const auto again = agreeingMotion(pairs, kTolerance_mm, {});
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->fixed_from_moving.rotation, again->fixed_from_moving.rotation);
  EXPECT_EQ(once->fixed_from_moving.translation, again->fixed_from_moving.translation);
}

// Descriptors that tell the number of the spot, but for noise.
SurfaceSpots spotsOf(const std::vector<int>& numbers, const std::vector<Eigen::Vector3d>& places,
                     std::uint64_t seed) {
  Random noise(seed);
  SurfaceSpots spots;
  for (const int number : numbers) {
    Random random(static_cast<std::uint64_t>(number) + 100);
    cv::Mat row(1, kLength, CV_32F);
    for (int i = 0; i < kLength; ++i) {
      row.at<float>(0, i) = static_cast<float>(100.0 * random.uniform() + 3.0 * noise.gaussian());
    }
    spots.descriptors.push_back(row);
    spots.places.push_back(places[static_cast<std::size_t>(number)]);
    spots.normals.emplace_back(0, 0, 1);
  }
  return spots;
}

TEST(PairSpots, PairsPlacesThoughTheyComeFromSeveralPictures) {
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 6; ++i) places.emplace_back(10.0 * i, 0.0, 0.0);
  const SurfaceSpots fixed = spotsOf({0, 1, 1, 2, 2, 2, 3}, places, 1);
  const SurfaceSpots moving = spotsOf({2, 1, 2, 5}, places, 2);
  const std::vector<SpotPair> pairs = pairSpots(fixed, moving, 1.0);
  ASSERT_EQ(pairs.size(), 3U);  // the fixed ones do not have the last
  EXPECT_EQ(pairs[0].fixed, places[2]);
  EXPECT_EQ(pairs[0].moving, places[2]);
  EXPECT_EQ(pairs[1].fixed, places[1]);
}

TEST(PairSpots, LeavesOutWhatComesTwice) {
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 3; ++i) places.emplace_back(10.0 * i, 0.0, 0.0);
  SurfaceSpots fixed = spotsOf({0, 1, 1}, places, 1);
  fixed.places[2] = places[2];  // the same look at another place
  EXPECT_EQ(pairSpots(fixed, spotsOf({1}, places, 2), 1.0).size(), 0U);
  EXPECT_TRUE(pairSpots({}, fixed, 1.0).empty());
  EXPECT_TRUE(pairSpots(fixed, {}, 1.0).empty());
}

}  // namespace
}  // namespace gyre
