// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/printed_target.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "core/calib/targets/standard_targets.h"
#include "core/geometry/turntable_pose.h"
#include "core/sim/renderer.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The default rig without noise, its picture cut down to what a target fills.
RigSettings targetRig() {
  RigSettings rig;
  rig.object = "target";
  rig.noise_sigma = 0.0;
  rig.image_width_px = 800;
  rig.image_height_px = 640;
  return rig;
}

Renderer rendererOf(const std::string& name, const RigSettings& rig) {
  return Renderer(rig, PrintedTarget::make(standardTarget(name)->target, rig).value());
}

// Where the points of the true target are in the picture after so many steps.
struct TruePoint {
  Vector2d pixel;
  double facing = 0.0;  // cosine between the face's way out and the way to the camera
  int face = -1;
  bool is_corner = false;
};
std::vector<TruePoint> truePoints(const Renderer& renderer, std::int64_t steps) {
  const RigSettings& rig = renderer.rig();
  const Calibration truth = trueCalibration(rig);
  const Rigid3 cam_from_table = camFromTable(*truth.cam_from_table, trueAngleRad(rig, steps));
  const Rigid3 cam_from_target = cam_from_table * tableFromTarget(rig);
  const Vector3d camera_in_target = cam_from_target.inverse().translation;
  const Target& target = renderer.target()->truth();
  std::vector<TruePoint> points;
  for (const TargetPoint& point : pointsOf(target)) {
    Vector3d outward = Vector3d::UnitZ();
    if (point.face >= 0 && !target.page_axes.empty()) {
      const PageAxes& axes = target.page_axes[static_cast<std::size_t>(point.face)];
      outward = axes.down_in_target.cross(axes.right_in_target);
    }
    const Vector3d to_camera = (camera_in_target - point.position_in_target).normalized();
    points.push_back({*truth.camera.project(cam_from_target * point.position_in_target),
                      outward.dot(to_camera), point.face, point.corner_id >= 0});
  }
  return points;
}

// The middle of an X corner: the saddle of a quadric fitted, with weights, to the grey levels
// within the radius, repeated about the place found. Independent of the detectors of the program.
Vector2d saddleNear(const cv::Mat& grey, Vector2d place, double radius) {
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    const int reach = static_cast<int>(radius) + 1;
    const int cx = static_cast<int>(std::lround(place.x()));
    const int cy = static_cast<int>(std::lround(place.y()));
    for (int y = cy - reach; y <= cy + reach; ++y) {
      for (int x = cx - reach; x <= cx + reach; ++x) {
        const double dx = x - place.x();
        const double dy = y - place.y();
        const double weight = radius - std::hypot(dx, dy);
        if (weight <= 0.0) continue;
        Eigen::Matrix<double, 6, 1> row;
        row << dx * dx, dx * dy, dy * dy, dx, dy, 1.0;
        normal += weight * row * row.transpose();
        right += weight * row * static_cast<double>(grey.at<float>(y, x));
      }
    }
    const Eigen::Matrix<double, 6, 1> q = normal.ldlt().solve(right);
    Eigen::Matrix2d hessian;
    hessian << 2 * q[0], q[1], q[1], 2 * q[2];
    const Vector2d step = -hessian.inverse() * Vector2d(q[3], q[4]);
    place += step;
    if (step.norm() < 1e-5) break;
  }
  return place;
}

cv::Mat greyOf(const Frame& frame) {
  cv::Mat grey;
  cv::cvtColor(frame.image_bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  return grey;
}

struct CornerErrors {
  double rms_px = 0.0;
  double worst_px = 0.0;
  Vector2d mean_px = Vector2d::Zero();
  int corners = 0;
};

// radius_px: of the fit; less than what separates a corner from the nearest code.
CornerErrors cornerErrors(const Renderer& renderer, const std::vector<std::int64_t>& stops,
                          double radius_px) {
  CornerErrors errors;
  double squares = 0.0;
  for (const std::int64_t steps : stops) {
    const cv::Mat grey = greyOf(renderer.render(steps, TableLoad::kObject));
    for (const TruePoint& point : truePoints(renderer, steps)) {
      if (!point.is_corner || point.facing < 0.45) continue;
      const Vector2d error = saddleNear(grey, point.pixel, radius_px) - point.pixel;
      squares += error.squaredNorm() / 2.0;
      errors.mean_px += error;
      errors.worst_px = std::max(errors.worst_px, error.norm());
      ++errors.corners;
    }
  }
  errors.mean_px /= errors.corners;
  errors.rms_px = std::sqrt(squares / errors.corners);
  return errors;
}

// 8 bits and a blur of 0.8 px leave a fit of this size about 0.005 px; perspective over its radius
// as much again. A texture sampled at pixel centres would leave some 0.1 px.
TEST(PrintedTarget, PutsCornersWhereTheTruthProjectsThem) {
  for (const char* name : {"cube", "wedge", "coded-cube"}) {
    const CornerErrors errors = cornerErrors(rendererOf(name, targetRig()), {400, 1777}, 6.0);
    EXPECT_GT(errors.corners, 40) << name;
    EXPECT_LT(errors.rms_px, 0.012) << name;
    EXPECT_LT(errors.mean_px.norm(), 0.005) << name;
    RecordProperty(std::string(name) + "_rms_px", std::to_string(errors.rms_px));
  }
}

TEST(PrintedTarget, PutsThemThereOnABoardLyingFlat) {
  // Seen under 30 degrees, its codes begin 3.4 px from the corners.
  const CornerErrors errors = cornerErrors(rendererOf("flat", targetRig()), {400}, 4.0);
  EXPECT_GT(errors.corners, 40);
  EXPECT_LT(errors.rms_px, 0.015);
}

TEST(PrintedTarget, ShowsItsImperfectionsWhereItsTruthHasThem) {
  RigSettings rig = targetRig();
  rig.target_bow_mm = 0.5;
  rig.target_fold_error_deg = 1.0;
  rig.print_scale_right = 0.97;
  rig.print_scale_down = 1.01;
  const Renderer renderer = rendererOf("wedge", rig);
  const CornerErrors errors = cornerErrors(renderer, {400, 1777}, 6.0);
  EXPECT_GT(errors.corners, 40);
  EXPECT_LT(errors.rms_px, 0.015);
  EXPECT_LT(errors.mean_px.norm(), 0.005);
}

// The codes that OpenCV reads, each where the truth has it.
std::vector<int> idsSeen(const Renderer& renderer, std::int64_t steps) {
  constexpr double kUnrefined_px = 3.0;  // its corners are of whole pixels of a thresholded picture
  const Frame frame = renderer.render(steps, TableLoad::kObject);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(
      frame.image_bgr, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250), corners, ids);
  const Target& target = renderer.target()->truth();
  const std::vector<TruePoint> truth = truePoints(renderer, steps);
  std::vector<int> right;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (std::size_t m = 0; m < target.markers.size(); ++m) {
      if (target.markers[m].id != ids[i]) continue;
      const TruePoint& first = truth[target.corners.size() + 4 * m];
      const Vector2d seen(corners[i][0].x, corners[i][0].y);
      if ((seen - first.pixel).norm() < kUnrefined_px) right.push_back(ids[i]);
    }
  }
  EXPECT_EQ(right.size(), ids.size());  // no code is read wrong
  return right;
}

// OpenCV is the independent reader.
TEST(PrintedTarget, ShowsCodesThatOpenCvReads) {
  RigSettings rig = targetRig();
  rig.noise_sigma = 2.0;
  EXPECT_GT(idsSeen(rendererOf("wedge", rig), 400).size(), 20U);
  EXPECT_GT(idsSeen(rendererOf("coded-cube", rig), 100).size(), 30U);
  rig.image_width_px = 1280;
  rig.image_height_px = 960;
  EXPECT_GE(idsSeen(rendererOf("ring", rig), 100).size(), 22U);
}

TEST(PrintedTarget, SaturatesWhenOverexposed) {
  RigSettings rig = targetRig();
  rig.exposure_gain = 4.0;
  const Frame bright = rendererOf("cube", rig).render(0, TableLoad::kObject);
  EXPECT_GT(cv::countNonZero(greyOf(bright) >= 254.5F), 20000);
}

TEST(PrintedTarget, LeavesTheTableEmptyWhenItIsTakenAway) {
  const RigSettings rig = targetRig();
  const Renderer renderer = rendererOf("wedge", rig);
  for (const TruePixel& pixel : renderer.truePixels(0, TableLoad::kEmpty)) {
    ASSERT_NE(pixel.surface, TruePixel::Surface::kObject);
  }
}

TEST(PrintedTarget, StaysOnThePlatterWhenTheObjectIsTakenAway) {
  RigSettings rig = targetRig();
  rig.object = "cube";
  rig.image_width_px = 1280;
  rig.image_height_px = 960;
  const Renderer renderer = rendererOf("ring", rig);
  const cv::Mat empty = renderer.render(0, TableLoad::kEmpty).image_bgr;
  const cv::Mat loaded = renderer.render(0, TableLoad::kObject).image_bgr;
  const auto codes = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(empty, codes, corners, ids);
  EXPECT_GE(ids.size(), 20U);
  cv::aruco::detectMarkers(loaded, codes, corners, ids);
  EXPECT_GE(ids.size(), 8U);  // the object hides those behind it
}

TEST(PrintedTarget, TellsWhatItCannotPaint) {
  Target target;
  target.corners = {{0, {0, 0, 0}}, {1, {10, 0, 0}}, {2, {0, 13, 0}}, {3, {17, 20, 0}}};
  target.faces = {{0, 1, 2, 3}};
  EXPECT_FALSE(PrintedTarget::make(target, targetRig()));
  target.faces.clear();
  EXPECT_FALSE(PrintedTarget::make(target, targetRig()));
  EXPECT_FALSE(PrintedTarget::make({}, targetRig()));
}

}  // namespace
}  // namespace gyre
