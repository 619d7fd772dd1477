// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/lens/tsai.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/base/units.h"
#include "core/calib/corners/point_spread.h"
#include "core/calib/lens/tsai_depth.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastPoints = 7;
constexpr std::size_t kLeastCoplanarPoints = 5;
constexpr double kLeastTilt_rad = radFromDeg(10.0);
// A second null vector this small beside the largest one: the equations leave a choice.
constexpr double kRankTolerance = 1e-9;

RadialView radialView(std::span<const KnownPoint> points, const Eigen::Vector2d& principal_px) {
  RadialView view;
  for (const KnownPoint& point : points) {
    view.points_in_target.push_back(point.position_in_target);
    view.offsets_px.emplace_back(point.pixel - principal_px);
  }
  return view;
}

Result<void> checkFinite(std::span<const KnownPoint> points, const Eigen::Vector2d& principal_px) {
  bool finite = principal_px.allFinite();
  for (const KnownPoint& point : points) {
    finite = finite && point.position_in_target.allFinite() && point.pixel.allFinite();
  }
  if (finite) return {};
  return Error{Error::Code::kInvalidInput, "A coordinate of a point is not a number.",
               "Give each point as X Y Z in mm and u v in px."};
}

Error tooFew(std::size_t given, std::size_t needed) {
  return {Error::Code::kTooFew,
          "Only " + std::to_string(given) + " points were given; the camera needs at least " +
              std::to_string(needed) + ".",
          "Add more points of the target."};
}

Error onOneLine() {
  return {Error::Code::kTooFew, "All points lie on one line.",
          "Use points that spread in all directions, such as the corners of a cube."};
}

// The unit vector that the rows leave, or nothing when they leave more than one.
std::optional<Eigen::VectorXd> nullVector(const Eigen::MatrixXd& rows) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::VectorXd& values = svd.singularValues();
  const Eigen::Index unknowns = rows.cols();
  if (values.size() < unknowns - 1) return std::nullopt;
  if (!(values[unknowns - 2] > kRankTolerance * values[0])) return std::nullopt;
  return svd.matrixV().col(unknowns - 1);
}

// Both sides of the radial alignment agree up to sign; points project on their own side.
double sideAgreement(const RadialView& view, const Eigen::Vector4d& p, const Eigen::Vector4d& q) {
  double agreement = 0.0;
  for (std::size_t i = 0; i < view.offsets_px.size(); ++i) {
    const Eigen::Vector4d x = view.points_in_target[i].homogeneous();
    agreement += view.offsets_px[i].x() * p.dot(x) + view.offsets_px[i].y() * q.dot(x);
  }
  return agreement;
}

// xd (r2 X + ty) = yd sx (r1 X + tx): linear in p = sx (r1, tx) and q = (r2, ty), up to scale.
Result<void> alignRadially(RadialView& view) {
  const auto count = static_cast<Eigen::Index>(view.offsets_px.size());
  const auto divisor = static_cast<double>(count);
  // Points about their middle and of size 1, pixels of size 1, or the rows are ill-conditioned.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : view.points_in_target) middle += x / divisor;
  double size_mm = 0.0;
  double size_px = 0.0;
  for (std::size_t i = 0; i < view.offsets_px.size(); ++i) {
    size_mm += (view.points_in_target[i] - middle).norm() / divisor;
    size_px += view.offsets_px[i].norm() / divisor;
  }
  if (!(size_px > 0.0)) return undeterminedCamera();
  Eigen::MatrixXd rows(count, 8);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Eigen::Vector3d scaled = (view.points_in_target[index] - middle) / size_mm;
    const Eigen::RowVector4d x = scaled.homogeneous().transpose();
    rows.row(i) << view.offsets_px[index].y() / size_px * x,
        -view.offsets_px[index].x() / size_px * x;
  }
  const auto solution = nullVector(rows);
  if (!solution) return undeterminedCamera();

  const auto unscaled = [&](const Eigen::Vector4d& scaled) {
    Eigen::Vector4d in_mm = scaled;
    in_mm.head<3>() /= size_mm;
    in_mm[3] -= in_mm.head<3>().dot(middle);
    return in_mm;
  };
  Eigen::Vector4d p = unscaled(solution->head<4>());
  Eigen::Vector4d q = unscaled(solution->tail<4>());
  const double scale = q.head<3>().norm();
  if (!(scale > 0.0) || !(p.head<3>().norm() > 0.0)) return undeterminedCamera();
  if (sideAgreement(view, p, q) < 0.0) {
    p = -p;
    q = -q;
  }
  q /= scale;
  p /= scale;
  view.aspect = p.head<3>().norm();
  p /= view.aspect;
  Eigen::Matrix3d nearly;
  nearly.row(0) = p.head<3>().transpose();
  nearly.row(1) = q.head<3>().transpose();
  nearly.row(2) = p.head<3>().cross(q.head<3>()).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(nearly, Eigen::ComputeFullU | Eigen::ComputeFullV);
  view.cam_from_target.rotation = svd.matrixU() * svd.matrixV().transpose();
  view.cam_from_target.translation = {p[3], q[3], 0.0};
  return {};
}

// From the upper left 2 x 2 of a rotation: the third column's entries up to one common sign.
Eigen::Matrix3d rotationFromBlock(const Eigen::Matrix2d& block, double sign) {
  Eigen::Vector3d r1(block(0, 0), block(0, 1), 0.0);
  Eigen::Vector3d r2(block(1, 0), block(1, 1), 0.0);
  r1.z() = sign * std::sqrt(std::max(0.0, 1.0 - r1.squaredNorm()));
  const double r2z = std::sqrt(std::max(0.0, 1.0 - r2.squaredNorm()));
  // r1 . r2 = 0
  r2.z() = r1.head<2>().dot(r2.head<2>()) * sign > 0.0 ? -r2z : r2z;
  Eigen::Matrix3d nearly;
  nearly << r1.transpose(), r2.transpose(), r1.cross(r2).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(nearly, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

// The radial alignment of points in the plane z = 0: five unknowns in homogeneous form. Gives tx
// and ty to the view and returns the upper left 2 x 2 of its rotation.
Result<Eigen::Matrix2d> alignPlane(RadialView& view, double size_mm) {
  const auto count = static_cast<Eigen::Index>(view.offsets_px.size());
  Eigen::MatrixXd rows(count, 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d& point = view.points_in_target[static_cast<std::size_t>(i)];
    const Eigen::Vector2d& offset = view.offsets_px[static_cast<std::size_t>(i)];
    const Eigen::RowVector3d x(point.x() / size_mm, point.y() / size_mm, 1.0);
    rows.row(i) << offset.y() * x, -offset.x() * x;
  }
  const auto solution = nullVector(rows);
  if (!solution) return undeterminedCamera();
  Eigen::Vector4d p((*solution)[0] / size_mm, (*solution)[1] / size_mm, 0.0, (*solution)[2]);
  Eigen::Vector4d q((*solution)[3] / size_mm, (*solution)[4] / size_mm, 0.0, (*solution)[5]);
  Eigen::Matrix2d block;
  block << p.head<2>().transpose(), q.head<2>().transpose();
  // The upper left of a rotation has the singular values 1 and the cosine of the tilt.
  const Eigen::Vector2d singular = block.jacobiSvd().singularValues();
  if (!(singular[0] > 0.0)) return undeterminedCamera();
  if (singular[1] / singular[0] > std::cos(kLeastTilt_rad)) {
    return Error{Error::Code::kTooFew,
                 "The target is seen too squarely to tell its distance from the focal length.",
                 "Tilt it by 30 degrees or more."};
  }
  const double scale = (sideAgreement(view, p, q) < 0.0 ? -1.0 : 1.0) / singular[0];
  view.cam_from_target.translation = scale * Eigen::Vector3d(p[3], q[3], 0.0);
  return Eigen::Matrix2d(scale * block);
}

}  // namespace

Result<TsaiCamera> calibrateTsai(std::span<const KnownPoint> points,
                                 const Eigen::Vector2d& principal_px) {
  if (auto finite = checkFinite(points, principal_px); !finite) return finite.error();
  if (points.size() < kLeastPoints) return tooFew(points.size(), kLeastPoints);
  const PointSpread spread = spreadOf(points);
  if (spread.onOneLine()) return onOneLine();
  if (spread.inOnePlane()) {
    return Error{Error::Code::kTooFew,
                 "All points lie in one plane, from which this method cannot find the camera.",
                 "Use a target with several faces, such as a cube."};
  }
  RadialView view = radialView(points, principal_px);
  if (auto aligned = alignRadially(view); !aligned) return aligned.error();
  return completeRadialView(view, principal_px);
}

Result<TsaiCamera> calibrateTsaiCoplanar(std::span<const KnownPoint> points,
                                         const Eigen::Vector2d& principal_px) {
  if (auto finite = checkFinite(points, principal_px); !finite) return finite.error();
  if (points.size() < kLeastCoplanarPoints) return tooFew(points.size(), kLeastCoplanarPoints);
  const PointSpread spread = spreadOf(points);
  if (spread.onOneLine()) return onOneLine();
  if (!spread.inOnePlane()) {
    return Error{Error::Code::kInvalidInput, "The points do not lie in one plane.",
                 "Use the method for points in space."};
  }
  RadialView view = radialView(points, principal_px);
  for (Eigen::Vector3d& point : view.points_in_target) {
    point = spread.principal_from_target * point;
  }
  const auto block = alignPlane(view, spread.size_mm.x());
  if (!block) return block.error();
  Result<TsaiCamera> camera = mirroredPoints();
  for (const double sign : {1.0, -1.0}) {
    view.cam_from_target.rotation = rotationFromBlock(*block, sign);
    camera = completeRadialView(view, principal_px);
    if (camera) break;
  }
  if (!camera) return camera.error();
  camera->cam_from_target = camera->cam_from_target * spread.principal_from_target;
  return camera;
}

}  // namespace gyre
