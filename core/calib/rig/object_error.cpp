// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/object_error.h"

#include <cmath>

#include <Eigen/Dense>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kPoints = 64;
constexpr double kUnderside = -0.8;  // cosine: what the ball stands on
constexpr double kHalfArc_rad = radFromDeg(50.0);
constexpr int kStepsToEitherSide = 10;

using RigColumns = Eigen::Matrix<double, 3, kCameraSize + kAxisSize>;

// dX/dc of one point.
RigColumns pointByRig(const RigFrames& frames, const Eigen::Vector3d& point_in_table,
                      const std::vector<double>& angles_rad) {
  const RigFrames at_table{frames.camera, frames.cam_from_base, Rigid3{}};
  FacePoint point;
  point.position_in_target = point_in_table;
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  RigColumns right = RigColumns::Zero();
  for (const double angle_rad : angles_rad) {
    RigParameters at;
    at.camera = cameraVector(frames.camera);
    at.angle_rad = angle_rad;
    Eigen::Vector2d pixel;
    RigJacobian by;
    if (!projectRig(at_table, at, point, &pixel, &by)) continue;
    Eigen::Matrix<double, 2, kCameraSize + kAxisSize> by_rig;
    by_rig << by.camera, by.axis;
    hessian += by.point_in_target.transpose() * by.point_in_target;
    right += by.point_in_target.transpose() * by_rig;
  }
  return -hessian.completeOrthogonalDecomposition().solve(right);
}

}  // namespace

std::vector<Eigen::Vector3d> probePoints(const ErrorProbe& probe) {
  std::vector<Eigen::Vector3d> points;
  const double golden_rad = kPi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / kPoints;
    if (z < kUnderside) continue;
    const double r = std::sqrt(1.0 - z * z);
    points.push_back(probe.middle_in_table + 0.5 * probe.diameter_mm *
                                                 Eigen::Vector3d(r * std::cos(golden_rad * i),
                                                                 r * std::sin(golden_rad * i), z));
  }
  return points;
}

std::vector<double> probeAngles(const ErrorProbe& probe, const Eigen::Vector3d& point_in_table) {
  const Eigen::Vector3d outward = point_in_table - probe.middle_in_table;
  const double facing_rad = -std::atan2(outward.y(), outward.x());
  std::vector<double> angles;
  for (int i = -kStepsToEitherSide; i <= kStepsToEitherSide; ++i) {
    angles.push_back(facing_rad + kHalfArc_rad * i / kStepsToEitherSide);
  }
  return angles;
}

SimilarityRest withoutSimilarity(const std::vector<Eigen::Vector3d>& points,
                                 const Eigen::MatrixXd& displacements) {
  Eigen::Vector3d midst = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) midst += point;
  midst /= static_cast<double>(points.size());
  Eigen::MatrixXd motions(displacements.rows(), 7);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d x = points[i] - midst;
    const auto row = 3 * static_cast<Eigen::Index>(i);
    motions.block<3, 3>(row, 0).setIdentity();
    motions.block<3, 3>(row, 3) << 0.0, x.z(), -x.y(), -x.z(), 0.0, x.x(), x.y(), -x.x(), 0.0;
    motions.block<3, 1>(row, 6) = x;
  }
  const Eigen::MatrixXd fitted = motions.colPivHouseholderQr().solve(displacements);
  return {displacements - motions * fitted, fitted.row(6)};
}

ObjectError predictObjectError(const RigFrames& frames, const RigCovarianceMatrix& covariance,
                               const ErrorProbe& probe) {
  const std::vector<Eigen::Vector3d> points = probePoints(probe);
  Eigen::MatrixXd by_rig(3 * static_cast<Eigen::Index>(points.size()), kCameraSize + kAxisSize);
  for (std::size_t i = 0; i < points.size(); ++i) {
    by_rig.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        pointByRig(frames, points[i], probeAngles(probe, points[i]));
  }
  const SimilarityRest rest = withoutSimilarity(points, by_rig);
  ObjectError error;
  const double squares = (rest.rest * covariance).cwiseProduct(rest.rest).sum();
  error.detail_mm = std::sqrt(std::max(0.0, squares / static_cast<double>(points.size())));
  error.size_share =
      std::sqrt(std::max(0.0, (rest.scale * covariance * rest.scale.transpose())(0)));
  return error;
}

}  // namespace gyre
