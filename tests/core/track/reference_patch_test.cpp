// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/reference_patch.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <opencv2/core.hpp>

#include "core/base/random.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

constexpr int kSide_px = 15;
const Eigen::Vector2d kMiddle(60, 50);

// The pattern seen through a place: what lay at kMiddle + d lies at place.pixel + place.shape d.
struct Light {
  double gain = 1.0;
  double offset = 0.0;
  double slope = 0.0;  // grey levels per pixel to the right
  double noise = 0.0;
};
cv::Mat seenThrough(const PatchPlace& place, const Light& light = {}) {
  Random random(11);
  cv::Mat grey(100, 120, CV_8U);
  const Eigen::Matrix2d back = place.shape.inverse();
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      const Eigen::Vector2d d = back * (Eigen::Vector2d(column, row) - place.pixel) + kMiddle;
      const double value = 128 + 90 * test::pattern(d.x() / 5.0, d.y() / 5.0, 9);
      grey.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(light.gain * value + light.offset + light.slope * column +
                                          light.noise * random.gaussian());
    }
  }
  return grey;
}

PatchPlace stretchedPlace() {
  PatchPlace place;
  place.pixel = {61.37, 48.81};
  place.shape << 0.85, 0.06, -0.04, 1.03;
  return place;
}

ReferencePatch reference() {
  return ReferencePatch::cut(seenThrough({kMiddle, Eigen::Matrix2d::Identity()}), kMiddle, kSide_px)
      .value();
}

TEST(ReferencePatch, FindsPlaceAndShape) {
  const auto found =
      reference().align(seenThrough(stretchedPlace()), {{60.5, 49.5}, Eigen::Matrix2d::Identity()});
  ASSERT_TRUE(found);
  // Rounding to grey levels and bilinear sampling leave some hundredths of a pixel.
  EXPECT_LT((found->place.pixel - stretchedPlace().pixel).norm(), 0.05);
  EXPECT_LT((found->place.shape - stretchedPlace().shape).norm(), 0.03);
  EXPECT_GT(found->correlation, 0.97);
}

TEST(ReferencePatch, IsNotMovedByLight) {
  const Light light{0.6, 30.0, 0.4, 0.0};
  const auto found = reference().align(seenThrough(stretchedPlace(), light),
                                       {{60.5, 49.5}, Eigen::Matrix2d::Identity()});
  ASSERT_TRUE(found);
  EXPECT_LT((found->place.pixel - stretchedPlace().pixel).norm(), 0.05);
}

TEST(ReferencePatch, PromisedSigmaCoversNoise) {
  const ReferencePatch patch = reference();
  const auto found = patch.align(seenThrough(stretchedPlace(), {1.0, 0.0, 0.0, 4.0}),
                                 {{61, 49}, Eigen::Matrix2d::Identity()});
  ASSERT_TRUE(found);
  EXPECT_GT(patch.sigmaPx(4.0), 0.0);
  EXPECT_LT((found->place.pixel - stretchedPlace().pixel).norm(), 5.0 * patch.sigmaPx(4.0) + 0.05);
}

TEST(ReferencePatch, IsNotFoundElsewhereOrOnPlainGround) {
  const auto elsewhere = reference().align(seenThrough({{20, 80}, Eigen::Matrix2d::Identity()}),
                                           {{60, 50}, Eigen::Matrix2d::Identity()});
  EXPECT_TRUE(!elsewhere || elsewhere->correlation < 0.8);
  EXPECT_FALSE(reference().align(cv::Mat(100, 120, CV_8U, cv::Scalar(90)),
                                 {{60, 50}, Eigen::Matrix2d::Identity()}));
}

TEST(ReferencePatch, NeedsTextureAndRoom) {
  const cv::Mat plain(100, 120, CV_8U, cv::Scalar(90));
  EXPECT_FALSE(ReferencePatch::cut(plain, kMiddle, kSide_px));
  EXPECT_FALSE(ReferencePatch::cut(seenThrough(stretchedPlace()), {5, 50}, kSide_px));
  EXPECT_FALSE(
      reference().align(seenThrough(stretchedPlace()), {{118, 50}, Eigen::Matrix2d::Identity()}));
}

}  // namespace
}  // namespace gyre
