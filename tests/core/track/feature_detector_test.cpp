// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/feature_detector.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

cv::Mat textured() {
  cv::Mat grey(160, 200, CV_8U);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      grey.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(128 + 80 * test::pattern(column / 4.0, row / 4.0, 3));
    }
  }
  return grey;
}

cv::Mat everywhere() { return {160, 200, CV_8U, cv::Scalar(255)}; }

TEST(DetectFeatures, SpreadsOneFeatureACell) {
  TrackOptions options;
  options.feature_spacing_px = 10;
  const auto features = detectFeatures(textured(), 1.0, everywhere(), {}, options);
  EXPECT_GT(features.size(), 300U);
  EXPECT_LE(features.size(), 320U);
}

TEST(DetectFeatures, LeavesOccupiedCellsAndForbiddenPlacesAlone) {
  TrackOptions options;
  options.feature_spacing_px = 10;
  cv::Mat allowed = everywhere();
  allowed.colRange(100, 200).setTo(0);
  const std::vector<Eigen::Vector2d> occupied = {{5, 5}, {15, 15}, {-3, 700}};
  const auto features = detectFeatures(textured(), 1.0, allowed, occupied, options);
  EXPECT_GT(features.size(), 140U);
  for (const Feature& feature : features) {
    EXPECT_LT(feature.pixel.x(), 100);
    EXPECT_FALSE(feature.pixel.x() < 10 && feature.pixel.y() < 10);
  }
}

TEST(DetectFeatures, FindsNothingOnPlainGroundAlongAnEdgeOrInPureNoise) {
  const TrackOptions options;
  EXPECT_TRUE(
      detectFeatures(cv::Mat(160, 200, CV_8U, cv::Scalar(99)), 1.0, everywhere(), {}, options)
          .empty());
  cv::Mat edge(160, 200, CV_8U, cv::Scalar(50));
  edge.colRange(100, 200).setTo(200);
  EXPECT_TRUE(detectFeatures(edge, 1.0, everywhere(), {}, options).empty());
  cv::Mat noise(160, 200, CV_8U);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::NORMAL, 128, 3.0);
  // Noise has gradients of its own; a few cells may pass by chance, most must not.
  EXPECT_LT(detectFeatures(noise, 3.0, everywhere(), {}, options).size(), 50U);
}

TEST(DetectFeatures, FindsNothingWhereNothingIsAllowed) {
  EXPECT_TRUE(
      detectFeatures(textured(), 1.0, cv::Mat::zeros(160, 200, CV_8U), {}, TrackOptions{}).empty());
}

TEST(DetectFeatures, PromisesWorseSigmaInNoisierPictures) {
  const auto calm = detectFeatures(textured(), 1.0, everywhere(), {}, TrackOptions{});
  const auto noisy = detectFeatures(textured(), 2.0, everywhere(), {}, TrackOptions{});
  ASSERT_FALSE(calm.empty() || noisy.empty());
  // Twice the noise, twice the sigma, but for what noise itself adds to the gradients.
  EXPECT_NEAR(noisy.front().sigma_px, 2.0 * calm.front().sigma_px, 0.05 * noisy.front().sigma_px);
}

}  // namespace
}  // namespace gyre
