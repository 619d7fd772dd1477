// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/picture_quality.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/calib/targets/standard_targets.h"
#include "tests/support/rendered_target.h"

namespace gyre {
namespace {

PictureQuality qualityOf(const cv::Mat& image) {
  return measureQuality(targetPicture(image).value());
}

cv::Mat picturedWedge(double psf_px) {
  test::TargetScene scene;
  scene.psf_px = psf_px;
  scene.noise = 1.0;
  return test::renderTarget(standardTarget("wedge")->target, test::plainCamera(640, 480),
                            test::lookAtTarget(260.0, radFromDeg(35.0), 0.3), scene);
}

class BlurOfEdges : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Scales, BlurOfEdges, testing::Values(1.0, 2.0, 4.0));

TEST_P(BlurOfEdges, ComesOutAsTheLensHasIt) {
  const PictureQuality quality = qualityOf(picturedWedge(GetParam()));
  ASSERT_TRUE(quality.blur_px);
  EXPECT_NEAR(*quality.blur_px, GetParam(), 0.4 * GetParam());
}

TEST(PictureQuality, TellsSharpFromBlurred) {
  EXPECT_LT(*qualityOf(picturedWedge(0.8)).blur_px, *qualityOf(picturedWedge(1.6)).blur_px);
  EXPECT_LT(*qualityOf(picturedWedge(1.6)).blur_px, *qualityOf(picturedWedge(3.2)).blur_px);
}

TEST(PictureQuality, CountsWhiteAndKnowsTheContrast) {
  cv::Mat image(200, 200, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(0, 0, 100, 200)).setTo(255);
  const PictureQuality half = qualityOf(image);
  EXPECT_NEAR(half.white_share, 0.5, 0.01);
  EXPECT_NEAR(half.contrast, 195.0, 30.0);
  EXPECT_EQ(half.brightest, 255.0);
}

TEST(PictureQuality, FindsNoEdgeOnAnEvenPicture) {
  const PictureQuality even = qualityOf(cv::Mat(200, 200, CV_8UC1, cv::Scalar(60)));
  EXPECT_FALSE(even.blur_px);
  EXPECT_EQ(even.contrast, 0.0);
  EXPECT_EQ(even.white_share, 0.0);
}

}  // namespace
}  // namespace gyre
