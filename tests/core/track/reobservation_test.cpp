// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/reobservation.h"

#include <cmath>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/track/grey_pyramid.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

constexpr int kViews = 36;

const std::vector<GreyView>& cylinderViews() {
  static const std::vector<GreyView> kGreyViews = [] {
    const test::TurningCylinder world;
    std::vector<GreyView> views;
    for (int view = 0; view < kViews; ++view) {
      const double angle_rad = radFromDeg(10.0 * view);
      const cv::Mat grey = greyOf(world.render(angle_rad).image_bgr);
      views.push_back({grey, camFromTable(*world.calibration().cam_from_table, angle_rad),
                       estimateNoiseSigma(grey)});
    }
    return views;
  }();
  return kGreyViews;
}

const std::vector<std::uint32_t>& anyView() {
  static const std::vector<std::uint32_t> kAll = [] {
    std::vector<std::uint32_t> all(kViews);
    for (std::uint32_t view = 0; view < kViews; ++view) all[view] = view;
    return all;
  }();
  return kAll;
}

// Points of the side, as it is: 30 mm from the axis.
std::vector<SurfacePoint> pointsOfTheSide() {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 60; ++i) {
    const double around_rad = radFromDeg(6.0 * i);
    const Eigen::Vector3d normal(std::cos(around_rad), std::sin(around_rad), 0.0);
    const Eigen::Vector3d along(-normal.y(), normal.x(), 0.0);
    const Eigen::Vector3d up(0, 0, 12.0 + 26.0 * (i % 7) / 6.0);
    points.push_back({30.0 * normal + up, normal, -along * along.transpose() / 30.0, anyView()});
  }
  return points;
}

std::vector<std::vector<Observation>> look(const std::vector<SurfacePoint>& points) {
  const test::TurningCylinder world;
  return reobserve(world.calibration().camera, cylinderViews(), points, {}, {}).value();
}

struct Misses {
  double rms_px = 0.0;
  int count = 0;
  double outwards_px = 0.0;  // mean along the direction in which a point further out would appear
};

// How far the observations are from where these points truly appear.
Misses missesOf(const std::vector<SurfacePoint>& truth,
                const std::vector<std::vector<Observation>>& seen) {
  const CameraModel camera = test::TurningCylinder{}.calibration().camera;
  Misses misses;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (const Observation& each : seen[i]) {
      const Rigid3& pose = cylinderViews()[static_cast<std::size_t>(each.view)].cam_from_table;
      const Eigen::Vector3d& place = truth[i].position_in_table;
      const Eigen::Vector2d pixel = *camera.project(pose * place);
      const Eigen::Vector2d further = *camera.project(pose * (place + truth[i].normal_in_table));
      misses.rms_px += (each.pixel - pixel).squaredNorm();
      misses.outwards_px += (each.pixel - pixel).dot(further - pixel) / (further - pixel).norm();
      ++misses.count;
    }
  }
  misses.rms_px = std::sqrt(misses.rms_px / misses.count);
  misses.outwards_px /= misses.count;
  return misses;
}

TEST(Reobserve, SeesPointsWhereTheyTrulyAppear) {
  const auto points = pointsOfTheSide();
  const Misses misses = missesOf(points, look(points));
  // The side is seen from within some 60 degrees of its normal: a third of 36 views.
  EXPECT_GT(misses.count, 60 * 9);
  EXPECT_LT(misses.rms_px, 0.08);
  EXPECT_LT(std::abs(misses.outwards_px), 0.015);
}

// A patch laid flat over a bulge is pulled to its mean depth: r^2 / 3 R for a patch of half side r.
TEST(Reobserve, IsPulledInwardsOnlyWhereTheBulgeIsNotTold) {
  const auto points = pointsOfTheSide();
  auto flat = points;
  for (SurfacePoint& point : flat) point.bending_in_table.setZero();
  EXPECT_LT(missesOf(points, look(flat)).outwards_px, -0.03);
  EXPECT_GT(missesOf(points, look(points)).outwards_px, -0.015);
}

TEST(Reobserve, GivesSigmasThatAreTrue) {
  const auto points = pointsOfTheSide();
  const auto seen = look(points);
  double squared = 0.0;
  double count = 0.0;
  const CameraModel camera = test::TurningCylinder{}.calibration().camera;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Observation& each : seen[i]) {
      const Rigid3& pose = cylinderViews()[static_cast<std::size_t>(each.view)].cam_from_table;
      const auto pixel = camera.project(pose * points[i].position_in_table);
      squared += (each.pixel - *pixel).squaredNorm() / (2.0 * each.sigma_px * each.sigma_px);
      count += 1.0;
    }
  }
  EXPECT_GT(squared / count, 0.3);
  EXPECT_LT(squared / count, 3.0);
}

TEST(Reobserve, CorrectsAPointThatIsSlightlyOff) {
  const auto truth = pointsOfTheSide();
  auto off = truth;
  for (SurfacePoint& point : off) point.position_in_table += 0.05 * point.normal_in_table;
  // The reference anchors the point where it was thought to be: an offset along the surface stays,
  // and one along the normal becomes a small one along the surface.
  EXPECT_LT(missesOf(truth, look(off)).outwards_px, 0.05);
  EXPECT_LT(missesOf(truth, look(off)).rms_px, 0.12);
}

TEST(Reobserve, LooksOnlyWhereTheNormalFaces) {
  const auto points = pointsOfTheSide();
  const auto seen = look(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::int32_t before = -1;
    for (const Observation& each : seen[i]) {
      EXPECT_GT(each.view, before);
      before = each.view;
      const Rigid3& pose = cylinderViews()[static_cast<std::size_t>(each.view)].cam_from_table;
      const Eigen::Vector3d towards =
          (pose.inverse().translation - points[i].position_in_table).normalized();
      EXPECT_GT(towards.dot(points[i].normal_in_table), 0.33);
    }
  }
}

TEST(Reobserve, SeesNothingOfWhatIsNotThere) {
  auto points = pointsOfTheSide();
  for (SurfacePoint& point : points) point.position_in_table *= 0.8;  // 6 mm inside
  int sightings = 0;
  for (const auto& seen : look(points)) sightings += static_cast<int>(seen.size());
  EXPECT_LT(sightings, 60 * 4);  // the reference itself, and chance
  for (SurfacePoint& point : points) point.normal_in_table *= -1.0;
  for (const auto& seen : look(points)) EXPECT_TRUE(seen.empty() || seen.size() < 3);
}

TEST(Reobserve, TakesPointsWithoutViewsOrNormals) {
  auto points = pointsOfTheSide();
  points[0].seen_by = {};
  points[1].normal_in_table.setZero();
  const auto seen = look(points);
  EXPECT_TRUE(seen[0].empty());
  EXPECT_TRUE(seen[1].empty());
  EXPECT_FALSE(seen[2].empty());
  EXPECT_TRUE(look({}).empty());
}

TEST(Reobserve, IsTheSameForAnyNumberOfThreadsAndStops) {
  const auto points = pointsOfTheSide();
  const auto many = look(points);
  {
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const auto single = look(points);
    for (std::size_t i = 0; i < many.size(); ++i) {
      ASSERT_EQ(single[i].size(), many[i].size());
      for (std::size_t k = 0; k < many[i].size(); ++k) {
        EXPECT_EQ(single[i][k].pixel, many[i][k].pixel);
      }
    }
  }
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = reobserve(test::TurningCylinder{}.calibration().camera, cylinderViews(),
                                 points, {}, Task(stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
