// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/object_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/scan/calibration.h"
#include "core/sim/rig.h"

namespace gyre {
namespace {

RigFrames defaultRig() {
  const Calibration truth = trueCalibration(RigSettings{});
  return {truth.camera, *truth.cam_from_table, Rigid3{}};
}

RigCovarianceMatrix oneSigma(int parameter, double sigma) {
  RigCovarianceMatrix covariance = RigCovarianceMatrix::Zero();
  covariance(parameter, parameter) = sigma * sigma;
  return covariance;
}

TEST(PredictObjectError, IsZeroForACertainCalibration) {
  const ObjectError error = predictObjectError(defaultRig(), RigCovarianceMatrix::Zero(), {});
  EXPECT_EQ(error.detail_mm, 0.0);
  EXPECT_EQ(error.size_share, 0.0);
}

TEST(PredictObjectError, GrowsInProportion) {
  const ObjectError one = predictObjectError(defaultRig(), oneSigma(2, 1.0), {});
  const ObjectError ten = predictObjectError(defaultRig(), oneSigma(2, 10.0), {});
  EXPECT_NEAR(ten.detail_mm, 10.0 * one.detail_mm, 1e-9);
  EXPECT_GT(one.detail_mm, 0.0);
}

TEST(PredictObjectError, AFocalLengthIsMostlySize) {
  // At a fixed distance of the axis 0.1 % more focal length makes a thing about 0.1 % smaller.
  const ObjectError error = predictObjectError(defaultRig(), oneSigma(0, 2.4), {});
  EXPECT_NEAR(error.size_share, 1e-3, 2e-4);
  EXPECT_LT(error.detail_mm, 0.01);
}

TEST(WithoutSimilarity, TakesAwayMotionAndScaleAndNothingElse) {
  const std::vector<Eigen::Vector3d> points = probePoints({});
  Eigen::VectorXd moved(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    moved.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        Eigen::Vector3d(1.0, 2.0, 3.0) + Eigen::Vector3d(0.1, -0.2, 0.3).cross(points[i]) +
        0.01 * points[i];
  }
  const SimilarityRest rest = withoutSimilarity(points, moved);
  EXPECT_LT(rest.rest.norm(), 1e-9);
  EXPECT_NEAR(rest.scale[0], 0.01, 1e-12);
}

}  // namespace
}  // namespace gyre
