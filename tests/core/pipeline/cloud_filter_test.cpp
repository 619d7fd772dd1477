// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/cloud_filter.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "tests/support/turning_cylinder.h"

namespace gyre {
namespace {

// Points on a sphere around (0, 0, 25), 20 mm in radius.
PointCloud sphere() {
  PointCloud cloud;
  for (int i = 0; i < 8000; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / 8000.0;
    const double azimuth = i * 2.399963;
    const double r = std::sqrt(1.0 - z * z);
    Point point;
    point.position = Eigen::Vector3d(0, 0, 25) +
                     20.0 * Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z);
    point.covariance = 1e-4 * Eigen::Matrix3d::Identity();
    cloud.points.push_back(point);
  }
  return cloud;
}

SilhouetteRecord noViews() { return SilhouetteRecord(test::TurningCylinder{}.calibration()); }

int kept(const std::vector<std::uint8_t>& keep) {
  return static_cast<int>(std::count(keep.begin(), keep.end(), 1));
}

TEST(JudgePoints, KeepsAGoodCloud) {
  const PointCloud cloud = sphere();
  EXPECT_EQ(kept(judgePoints(cloud, noViews(), {}, Scrutiny::kFull)), 8000);
}

TEST(JudgePoints, DropsUncertainPointsAndLonelyOnes) {
  PointCloud cloud = sphere();
  cloud.points[7].covariance = 4.0 * Eigen::Matrix3d::Identity();
  cloud.points[8].position = {60, 0, 60};
  const auto keep = judgePoints(cloud, noViews(), {}, Scrutiny::kFull);
  EXPECT_EQ(keep[7], 0);
  EXPECT_EQ(keep[8], 0);
  EXPECT_EQ(kept(keep), 7998);
}

TEST(JudgePoints, DropsWhatLeavesTheOutlines) {
  const Calibration calibration = test::TurningCylinder{}.calibration();
  SilhouetteRecord silhouettes(calibration);
  // The object's mask: only what projects left of the axis' image in the view at angle 0.
  cv::Mat left = cv::Mat::zeros(300, 400, CV_8U);
  left.colRange(0, 200).setTo(255);
  silhouettes.addView(left, 0.0);
  const PointCloud cloud = sphere();
  const auto keep = judgePoints(cloud, silhouettes, {}, Scrutiny::kFull);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const auto pixel =
        calibration.camera.project(*calibration.cam_from_table * cloud.points[i].position);
    if (pixel->x() > 212) {
      EXPECT_EQ(keep[i], 0);
    }
    if (pixel->x() < 190) {
      EXPECT_EQ(keep[i], 1);
    }
  }
}

TEST(SilhouetteRecord, LearnsNothingFromAMaskOfEverything) {
  SilhouetteRecord silhouettes = noViews();
  silhouettes.addView(cv::Mat(300, 400, CV_8U, cv::Scalar(255)), 0.0);
  EXPECT_EQ(silhouettes.outsideShare({0, 0, 25}, 10), 0.0);
}

TEST(JudgePoints, TakesAnEmptyCloud) {
  EXPECT_TRUE(judgePoints({}, noViews(), {}, Scrutiny::kFull).empty());
}

}  // namespace
}  // namespace gyre
