// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_camera.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/io/picture_file.h"
#include "core/pipeline/find_angles.h"
#include "core/pipeline/model_scale.h"
#include "core/pipeline/solve_camera.h"
#include "tests/support/temp_dir.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

constexpr int kViews = 36;

// A whole turn of the cylinder, before a wall that stands still, and nothing else.
class FindCamera : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    dir = std::make_unique<TempDir>();
    const test::TurningCylinder world;
    std::filesystem::create_directories(dir->path() / "pictures");
    for (int view = 0; view < kViews; ++view) {
      char name[16];
      std::snprintf(name, sizeof name, "v%02d.png", view);
      const double angle_rad = radFromDeg(360.0 / kViews * view);
      ASSERT_TRUE(writePicture(dir->path() / "pictures" / name, world.render(angle_rad).image_bgr));
    }
    ASSERT_TRUE(writePicture(dir->path() / "empty.png", world.renderEmpty().image_bgr));
    matched = matchPictures(prepared().views, {}).value();
  }
  static void TearDownTestSuite() { dir.reset(); }

  static PreparedPictures prepared(std::optional<double> step_rad = std::nullopt) {
    PictureSet set;
    set.pictures = dir->path() / "pictures";
    set.background = dir->path() / "empty.png";
    set.step_rad = step_rad;
    return preparePictures(set).value();
  }

  // Elevation of the camera over the table: its tilt is told by pictures alone. [deg]
  static double elevationDeg(const Calibration& calibration) {
    return degFromRad(-std::asin(calibration.cam_from_table->rotation(2, 2)));
  }

  const test::TurningCylinder world_{};
  static inline std::unique_ptr<TempDir> dir;
  static inline MatchedPictures matched;
};

TEST_F(FindCamera, FromNothingButPictures) {
  PreparedPictures pictures = prepared();
  EXPECT_FALSE(pictures.angles_told);
  const auto found = findCamera(pictures, matched, {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_GT(*found, 500U);
  const auto steps = findAngles(pictures, matched);
  ASSERT_TRUE(steps) << steps.error().sentence();
  EXPECT_NEAR(degFromRad(steps->common_rad), 10.0, 0.05);
  EXPECT_TRUE(pictures.angles_told);

  const auto refined = solveCamera(pictures, {}, {false, false}, {});
  ASSERT_TRUE(refined) << refined.error().sentence();
  const Calibration truth = world_.calibration();
  const Calibration& calibration = pictures.calibration.calibration;
  EXPECT_NEAR(refined->focal_px / truth.camera.fx, 1.0, 0.03);
  EXPECT_NEAR(elevationDeg(calibration), elevationDeg(truth), 2.0);
  EXPECT_LE(refined->rms_after_px, refined->rms_before_px);
  double worst_deg = 0.0;
  for (int view = 0; view < kViews; ++view) {
    const double off_deg =
        degFromRad(pictures.views[static_cast<std::size_t>(view)].table_angle_rad) - 10.0 * view;
    worst_deg = std::max(worst_deg, std::abs(off_deg));
  }
  EXPECT_LT(worst_deg, 0.1);

  auto model = reconstruct(pictures, {}, {}, {});
  ASSERT_TRUE(model);
  Calibration scaled = calibration;
  scaleModel(*model, scaled, 100.0);
  // A cylinder's side is as far from the axis everywhere, to a share of its radius.
  std::vector<double> radii_mm;
  for (const Point& point : model->cloud.points) {
    if (std::abs(point.normal.z()) < 0.3) radii_mm.push_back(point.position.head<2>().norm());
  }
  ASSERT_GT(radii_mm.size(), 300U);
  double mean_mm = 0.0;
  for (const double radius_mm : radii_mm) mean_mm += radius_mm;
  mean_mm /= static_cast<double>(radii_mm.size());
  double squares = 0.0;
  for (const double radius_mm : radii_mm) squares += std::pow(radius_mm / mean_mm - 1.0, 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(radii_mm.size())), 0.006);
}

TEST_F(FindCamera, WithAnglesThatAreToldKnowsWhichWayIsUp) {
  PreparedPictures pictures = prepared(radFromDeg(10.0));
  EXPECT_TRUE(pictures.angles_told);
  ASSERT_TRUE(findCamera(pictures, matched, {}));
  EXPECT_NEAR(elevationDeg(pictures.calibration.calibration), elevationDeg(world_.calibration()),
              4.0);
  EXPECT_LT(pictures.calibration.calibration.cam_from_table->rotation(1, 2), 0.0);
}

TEST_F(FindCamera, OfACalibrationThatIsRoughlyKnown) {
  PreparedPictures pictures = prepared(radFromDeg(10.0));
  Calibration rough = world_.calibration();
  const Eigen::Vector3d centre = rough.cam_from_table->inverse().translation;
  const Eigen::AngleAxisd off(radFromDeg(1.5), Eigen::Vector3d(1.0, 0.5, 0.2).normalized());
  rough.cam_from_table->rotation = off.toRotationMatrix() * rough.cam_from_table->rotation;
  rough.cam_from_table->translation = -(rough.cam_from_table->rotation * centre);
  pictures.calibration = CalibrationRecord(rough);
  pictures.calibration.report = CalibrationReport{};
  pictures.calibration.target = "ring";
  ASSERT_TRUE(turnCamera(pictures, matched, {}));
  const auto refined = solveCamera(pictures, {}, {true, true}, {});
  ASSERT_TRUE(refined) << refined.error().sentence();
  EXPECT_FALSE(pictures.calibration.report);  // it was about another calibration
  EXPECT_EQ(pictures.calibration.target, "ring");
  const Eigen::Matrix3d left = pictures.calibration.calibration.cam_from_table->rotation *
                               world_.calibration().cam_from_table->rotation.transpose();
  EXPECT_LT(degFromRad(Eigen::AngleAxisd(left).angle()), 0.3);
}

TEST_F(FindCamera, RefusesLessThanATurnOfWhichNothingIsKnown) {
  PreparedPictures pictures = prepared();
  pictures.views.resize(18);
  const auto found = findCamera(pictures, matchPictures(pictures.views, {}).value(), {});
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().sentence().find("--step-deg"), std::string::npos);
  EXPECT_FALSE(pictures.calibration.calibration.cam_from_table);
}

TEST_F(FindCamera, StopsWhenAsked) {
  PreparedPictures pictures = prepared();
  std::stop_source stop;
  stop.request_stop();
  const Task task(stop.get_token());
  const auto stopped = matchPictures(pictures.views, task);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
  pictures.calibration = CalibrationRecord(world_.calibration());
  const auto refined = solveCamera(pictures, {}, {}, task);
  ASSERT_FALSE(refined);
  EXPECT_EQ(refined.error().code, Error::Code::kCancelled);
}

TEST(FindCameraOf, ATableThatStandsStillIsRefused) {
  const TempDir dir;
  const test::TurningCylinder world;
  PictureSet set;
  set.pictures = dir.path();
  for (int view = 0; view < 4; ++view) {
    const std::string name = "v" + std::to_string(view) + ".png";
    ASSERT_TRUE(writePicture(dir.path() / name, world.render(0.0).image_bgr));
  }
  PreparedPictures pictures = preparePictures(set).value();
  const auto found = findCamera(pictures, matchPictures(pictures.views, {}).value(), {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Error::Code::kTooFew);
  EXPECT_FALSE(pictures.calibration.calibration.cam_from_table);
}

}  // namespace
}  // namespace gyre
