// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_hindrance.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/base/units.h"
#include "core/calib/match/find_target.h"
#include "core/calib/match/target_preview.h"
#include "core/calib/targets/standard_targets.h"
#include "tests/support/rendered_target.h"

namespace gyre {
namespace {

using test::lookAtTarget;
using test::TargetScene;
using testing::HasSubstr;

Target standard(const std::string& name) { return standardTarget(name)->target; }

struct View {
  double distance_mm = 260.0;
  double aim_height_mm = 15.0;
  TargetScene scene = {};
};

cv::Mat pictureOf(const Target& target, const View& view = {}) {
  TargetScene scene = view.scene;
  if (scene.noise == 0.0) scene.noise = 1.0;
  return test::renderTarget(
      target, test::plainCamera(640, 480),
      lookAtTarget(view.distance_mm, radFromDeg(35.0), radFromDeg(20.0), view.aim_height_mm),
      scene);
}

std::string whyNot(const cv::Mat& image, const Target& target) {
  const auto found = findTarget(image, target);
  if (found) return "found";
  EXPECT_FALSE(found.error().advice.empty());
  return found.error().what;
}

class Hindrance : public testing::TestWithParam<const char*> {
 protected:
  Target target() const { return standard(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Targets, Hindrance,
                         testing::Values("cube", "wedge", "coded-cube", "ring"));

TEST_P(Hindrance, IsNoneInAGoodPicture) {
  EXPECT_EQ(whyNot(pictureOf(target()), target()), "found");
}

TEST_P(Hindrance, IsThatTheTargetIsAbsent) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(110));
  cv::rectangle(image, {200, 150}, {420, 330}, cv::Scalar(60, 90, 200), cv::FILLED);
  cv::circle(image, {100, 100}, 50, cv::Scalar(240, 240, 240), cv::FILLED);
  EXPECT_THAT(whyNot(image, target()), HasSubstr("is in the picture"));
  EXPECT_THAT(whyNot(image, target()), HasSubstr("No "));
}

TEST_P(Hindrance, IsThatNothingIsSharpInAnEmptyPicture) {
  EXPECT_THAT(whyNot(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(128)), target()),
              HasSubstr("nothing with sharp edges"));
}

TEST_P(Hindrance, IsBlur) {
  View view;
  view.scene.psf_px = 6.0;
  EXPECT_THAT(whyNot(pictureOf(target(), view), target()), HasSubstr("blurred"));
}

TEST_P(Hindrance, IsTooMuchLight) {
  View view;
  view.scene.dark = 300.0;
  view.scene.bright = 500.0;
  view.scene.ground = 400.0;
  EXPECT_THAT(whyNot(pictureOf(target(), view), target()), HasSubstr("over-exposed"));
}

TEST_P(Hindrance, IsTooLittleLight) {
  View view;
  view.scene.dark = 2.0;
  view.scene.bright = 6.0;
  view.scene.ground = 4.0;
  EXPECT_THAT(whyNot(pictureOf(target(), view), target()), HasSubstr("too dark"));
}

TEST_P(Hindrance, IsThatTheTargetIsTooSmall) {
  View view;
  // Squares of 4 px and less, and codes of about 10.
  view.distance_mm = target().dictionary.empty() ? 1500.0 : target().faces.empty() ? 520.0 : 640.0;
  EXPECT_THAT(whyNot(pictureOf(target(), view), target()), HasSubstr("too small"));
}

TEST_P(Hindrance, IsThatTheTargetIsCutOff) {
  const cv::Mat image = pictureOf(target());
  const auto camera = test::plainCamera(640, 480);
  const Rigid3 cam_from_target = lookAtTarget(260.0, radFromDeg(35.0), radFromDeg(20.0));
  double left = 1e9;
  double right = 0.0;
  for (std::size_t i = 0; i < pointsOf(target()).size(); ++i) {
    const auto pixel = test::truePixel(target(), camera, cam_from_target, static_cast<int>(i));
    left = std::min(left, pixel->x());
    right = std::max(right, pixel->x());
  }
  // What is left of it is its left half, at the right edge of the picture.
  const int width = static_cast<int>(left + 0.45 * (right - left));
  FindTargetOptions options;
  options.min_points = 60;
  const auto found = findTarget(image(cv::Rect(0, 0, width, 480)).clone(), target(), options);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().what, HasSubstr("cut off"));
}

TEST(WhyNotFound, IsAnotherTargetOfTheSameFamily) {
  const std::string why = whyNot(pictureOf(standard("wedge")), standard("coded-cube"));
  EXPECT_THAT(why, HasSubstr("Another target"));
  EXPECT_THAT(why, HasSubstr("coded-cube"));
}

TEST(WhyNotFound, IsAnotherFamilyOfCodes) {
  Target other = standard("wedge");
  other.dictionary = "DICT_6X6_250";
  const std::string why = whyNot(pictureOf(other), standard("wedge"));
  EXPECT_THAT(why, HasSubstr("Another target"));
  EXPECT_THAT(why, HasSubstr("DICT_6X6"));
}

TEST(WhyNotFound, IsACheckerboardOfAnotherSize) {
  // Nothing but a cloth: its squares go on and on.
  Target nothing;
  View view;
  view.scene.cloth_square_mm = 9.0;
  const std::string why = whyNot(pictureOf(nothing, view), standard("cube"));
  EXPECT_THAT(why, HasSubstr("Another target"));
  EXPECT_THAT(why, HasSubstr("5 x 5"));
}

TEST(WhyNotFound, IsTooFewPointsWhenMostIsHidden) {
  const Target wedge = standard("wedge");
  cv::Mat image = pictureOf(wedge);
  cv::rectangle(image, {0, 0}, {300, 480}, cv::Scalar::all(100), cv::FILLED);
  cv::rectangle(image, {350, 0}, {640, 480}, cv::Scalar::all(100), cv::FILLED);
  cv::rectangle(image, {0, 250}, {640, 480}, cv::Scalar::all(100), cv::FILLED);
  FindTargetOptions options;
  options.min_points = 20;
  const auto found = findTarget(image, wedge, options);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().what, HasSubstr("Only "));
  EXPECT_THAT(found.error().what, HasSubstr("20 are needed"));
}

TEST(TargetPreview, ShowsWhatIsFoundFaceByFace) {
  const Target cube = standard("coded-cube");
  const auto camera = test::plainCamera(1280, 960);
  const Rigid3 cam_from_target = lookAtTarget(260.0, radFromDeg(35.0), radFromDeg(40.0));
  const cv::Mat image = test::renderTarget(cube, camera, cam_from_target);
  const TargetSight preview = previewTarget(image, cube);
  EXPECT_TRUE(preview.passes) << preview.sentence;
  ASSERT_EQ(preview.faces.size(), cube.faces.size());
  EXPECT_TRUE(preview.faces.front().passes);
  // The side that looks away is told with its points, none of them seen.
  EXPECT_TRUE(std::any_of(preview.faces.begin(), preview.faces.end(), [](const FaceSight& face) {
    return face.seen == 0 && face.points > 0 && !face.passes;
  }));
  EXPECT_THAT(preview.sentence, HasSubstr("points on"));
  const auto full = findTarget(image, cube);
  ASSERT_TRUE(full);
  double nearest_px = 1e9;
  for (const auto& pixel : preview.found_px) {
    nearest_px =
        std::min(nearest_px, (pixel.cast<double>() - full->view.sightings.front().pixel).norm());
  }
  EXPECT_LT(nearest_px, 0.5);
}

TEST(TargetPreview, SaysWhatHinders) {
  const TargetSight preview =
      previewTarget(cv::Mat(960, 1280, CV_8UC3, cv::Scalar::all(3)), standard("cube"));
  EXPECT_FALSE(preview.passes);
  EXPECT_THAT(preview.sentence, HasSubstr("too dark"));
}

}  // namespace
}  // namespace gyre
