// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/point_normals.h"

#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

std::vector<Eigen::Vector3d> truthOf(PointCloud& cloud) {
  std::vector<Eigen::Vector3d> truth;
  for (Point& point : cloud.points) {
    truth.push_back(point.normal);
    point.normal.setZero();
  }
  return truth;
}

TEST(SetPointNormals, FollowTheCameras) {
  PointCloud cloud = test::torusCloud(5000, 20.0, 6.0);
  test::addNoise(cloud, 0.03, 5);
  const auto truth = truthOf(cloud);
  std::vector<Eigen::Vector3d> towards_camera = truth;
  for (Eigen::Vector3d& direction : towards_camera) direction += Eigen::Vector3d(0.3, 0.2, 0.5);
  ASSERT_TRUE(setPointNormals(cloud, towards_camera, {}, {}));
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += cloud.points[i].normal.dot(truth[i]);
  EXPECT_GT(sum / 5000.0, 0.995);
}

TEST(SetPointNormals, FindTheOutsideWithoutCameras) {
  PointCloud cloud = test::torusCloud(5000, 20.0, 6.0);
  const auto truth = truthOf(cloud);
  ASSERT_TRUE(setPointNormals(cloud, {}, {}, {}));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_GT(cloud.points[i].normal.dot(truth[i]), 0.8);
  }
}

TEST(SetPointNormals, StayZeroOnALine) {
  PointCloud line;
  for (int i = 0; i < 20; ++i)
    line.points.push_back(test::surfacePoint({1.0 * i, 0, 0}, {0, 0, 0}));
  ASSERT_TRUE(setPointNormals(line, {}, {}, {}));
  for (const Point& point : line.points) EXPECT_TRUE(point.normal.isZero());
}

TEST(SetPointNormals, LeaveTheCloudAloneWhenStopped) {
  PointCloud cloud = test::sphereCloud(500, 10.0);
  truthOf(cloud);
  std::stop_source stop;
  stop.request_stop();
  const auto outcome = setPointNormals(cloud, {}, {}, Task(stop.get_token()));
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Error::Code::kCancelled);
  EXPECT_TRUE(cloud.points[0].normal.isZero());
}

}  // namespace
}  // namespace gyre
