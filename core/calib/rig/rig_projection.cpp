// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_projection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gyre {
namespace {

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

// d(pixel) / d(focal length, aspect, cx, cy, k1, k2, k3, p1, p2) at undistorted coordinates.
Eigen::Matrix<double, 2, kCameraSize> cameraJacobian(const CameraModel& camera,
                                                     const Eigen::Vector2d& normalized) {
  const double x = normalized.x();
  const double y = normalized.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3));
  const double xd = x * radial + 2.0 * camera.p1 * x * y + camera.p2 * (r2 + 2.0 * x * x);
  const double yd = y * radial + camera.p1 * (r2 + 2.0 * y * y) + 2.0 * camera.p2 * x * y;
  Eigen::Matrix2d pixel_from_distorted;
  pixel_from_distorted << camera.fx, camera.skew, 0.0, camera.fy;
  Eigen::Matrix<double, 2, kCameraSize> jacobian;
  jacobian.col(0) << xd, camera.fy / camera.fx * yd;
  jacobian.col(1) << 0.0, camera.fx * yd;
  jacobian.col(2) << 1.0, 0.0;
  jacobian.col(3) << 0.0, 1.0;
  jacobian.col(4) = pixel_from_distorted * normalized * r2;
  jacobian.col(5) = jacobian.col(4) * r2;
  jacobian.col(6) = jacobian.col(5) * r2;
  jacobian.col(7) = pixel_from_distorted * Eigen::Vector2d(2.0 * x * y, r2 + 2.0 * y * y);
  jacobian.col(8) = pixel_from_distorted * Eigen::Vector2d(r2 + 2.0 * x * x, 2.0 * x * y);
  return jacobian;
}

// The largest distances from the middle along the sheet's two directions.
void measure(const std::vector<TargetPoint>& points, TargetPiece& face) {
  double along = 0.0;
  double across = 0.0;
  for (const int index : face.points) {
    const Eigen::Vector3d from_middle =
        points[static_cast<std::size_t>(index)].position_in_target - face.middle;
    along = std::max(along, std::abs(face.along.dot(from_middle)));
    across = std::max(across, std::abs(face.across.dot(from_middle)));
  }
  if (along > 0.0) face.half_along_mm = along;
  if (across > 0.0) face.half_across_mm = across;
}

// Middle, directions and size from the points; the frame's own directions when they span no plane.
void fitPlane(const std::vector<TargetPoint>& points, TargetPiece& face) {
  const auto at = [&](int index) -> const Eigen::Vector3d& {
    return points[static_cast<std::size_t>(index)].position_in_target;
  };
  face.middle.setZero();
  for (const int index : face.points) face.middle += at(index);
  face.middle /= static_cast<double>(face.points.size());
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < face.points.size(); ++i) {
    const Eigen::Vector3d side = at(face.points[i]) - at(face.points[0]);
    if (along.isZero()) along = side;
    if (along.cross(side).norm() > normal.norm()) normal = along.cross(side);
  }
  if (normal.isZero()) return;
  face.along = along.normalized();
  face.normal = normal.normalized();
  face.across = face.normal.cross(face.along);
  measure(points, face);
}

// So that a bow is positive where the sheet bulges: away from the target's midst, or up when flat.
void turnOutwards(const Eigen::Vector3d& midst, TargetPiece& face) {
  const double out_mm = face.normal.dot(face.middle - midst);
  const double side = std::abs(out_mm) > 1e-6 ? out_mm : face.normal.z();
  if (side >= 0.0) return;
  face.normal = -face.normal;
  face.across = -face.across;
}

}  // namespace

CameraVector cameraVector(const CameraModel& camera) {
  CameraVector vector;
  vector << camera.fx, camera.fy / camera.fx, camera.cx, camera.cy, camera.k1, camera.k2, camera.k3,
      camera.p1, camera.p2;
  return vector;
}

CameraModel cameraFrom(const CameraVector& vector, CameraModel base) {
  base.fx = vector[0];
  base.fy = vector[0] * vector[1];
  base.cx = vector[2];
  base.cy = vector[3];
  base.k1 = vector[4];
  base.k2 = vector[5];
  base.k3 = vector[6];
  base.p1 = vector[7];
  base.p2 = vector[8];
  return base;
}

std::vector<TargetPiece> facePiecesOf(const Target& target) {
  const std::vector<TargetPoint> points = pointsOf(target);
  std::vector<TargetPiece> faces(target.faces.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].face < 0) continue;
    faces[static_cast<std::size_t>(points[i].face)].points.push_back(static_cast<int>(i));
  }
  Eigen::Vector3d midst = Eigen::Vector3d::Zero();
  for (const TargetPoint& point : points) midst += point.position_in_target;
  midst /= std::max<double>(1.0, static_cast<double>(points.size()));
  for (TargetPiece& face : faces) {
    if (face.points.empty()) continue;
    fitPlane(points, face);
    turnOutwards(midst, face);
  }
  return faces;
}

std::vector<TargetPiece> loosePiecesOf(const Target& target) {
  const std::vector<TargetPoint> points = pointsOf(target);
  std::vector<TargetPiece> pieces;
  for (std::size_t marker = 0; marker < target.markers.size(); ++marker) {
    TargetPiece piece;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      piece.points.push_back(static_cast<int>(target.corners.size() + 4 * marker + corner));
    }
    fitPlane(points, piece);
    pieces.push_back(piece);
  }
  return pieces;
}

FacePoint facePoint(const Target& target, const TargetPiece& face, int face_index,
                    const Eigen::Vector3d& position_in_target) {
  FacePoint point;
  point.position_in_target = position_in_target;
  point.from_middle = position_in_target - face.middle;
  point.normal = face.normal;
  const double u = face.along.dot(point.from_middle) / face.half_along_mm;
  const double v = face.across.dot(point.from_middle) / face.half_across_mm;
  // Less their mean over the sheet, so that a bow is no shift.
  point.bow = {u * u - 1.0 / 3.0, u * v, v * v - 1.0 / 3.0};
  if (face_index >= 0 && static_cast<std::size_t>(face_index) < target.page_axes.size()) {
    const PageAxes& page = target.page_axes[static_cast<std::size_t>(face_index)];
    point.stretch = 0.5 * (page.right_in_target.dot(point.from_middle) * page.right_in_target -
                           page.down_in_target.dot(point.from_middle) * page.down_in_target);
  }
  return point;
}

Eigen::Matrix3d rotationBy(const Eigen::Vector3d& turn_rad) {
  const double angle_rad = turn_rad.norm();
  if (angle_rad < 1e-12) return Eigen::Matrix3d::Identity() + crossMatrix(turn_rad);
  return Eigen::AngleAxisd(angle_rad, turn_rad / angle_rad).toRotationMatrix();
}

Eigen::Matrix3d turnJacobian(const Eigen::Vector3d& turn_rad, const Eigen::Vector3d& x) {
  // -R(w) [x] J(w) with the right Jacobian of rotations
  //   J(w) = I - (1 - cos a)/a^2 [w] + (a - sin a)/a^3 [w]^2.
  const double angle2 = turn_rad.squaredNorm();
  const double angle = std::sqrt(angle2);
  const double b = angle < 1e-4 ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const double c =
      angle < 1e-4 ? 1.0 / 6.0 - angle2 / 120.0 : (angle - std::sin(angle)) / (angle2 * angle);
  const Eigen::Matrix3d w = crossMatrix(turn_rad);
  return -rotationBy(turn_rad) * crossMatrix(x) * (Eigen::Matrix3d::Identity() - b * w + c * w * w);
}

Eigen::Vector3d correctedInTarget(const RigParameters& at, const FacePoint& point) {
  const Eigen::Vector3d stretched = point.from_middle + at.page_stretch * point.stretch;
  const Eigen::Vector3d middle = point.position_in_target - point.from_middle;
  return rotationBy(at.face.head<3>()) * stretched + middle + at.face.segment<3>(3) +
         point.bow.dot(at.face.tail<3>()) * point.normal;
}

bool projectRig(const RigFrames& frames, const RigParameters& at, const FacePoint& point,
                Eigen::Vector2d* pixel, RigJacobian* jacobian) {
  const Eigen::Vector3d in_target = correctedInTarget(at, point);
  const Eigen::Matrix3d target_turn = rotationBy(at.target.head<3>());
  const Eigen::Vector3d in_table =
      frames.table_from_target * (target_turn * in_target + at.target.tail<3>());
  const Eigen::Matrix3d base_from_table =
      Eigen::AngleAxisd(at.angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d in_base = base_from_table * in_table;
  const Eigen::Vector3d axis_turn(at.axis[0], at.axis[1], 0.0);
  const Eigen::Matrix3d axis_rotation = rotationBy(axis_turn);
  const Eigen::Vector3d axis_shift(at.axis[2], at.axis[3], 0.0);
  const Eigen::Vector3d in_cam = frames.cam_from_base * (axis_rotation * in_base + axis_shift);
  if (!(in_cam.z() > 1e-6)) return false;
  const CameraModel camera = cameraFrom(at.camera, frames.camera);
  const Eigen::Vector2d normalized = in_cam.head<2>() / in_cam.z();
  *pixel = camera.pixelFromNormalized(normalized);
  if (jacobian == nullptr) return true;

  Eigen::Matrix<double, 2, 3> normalized_by_cam;
  normalized_by_cam << 1.0, 0.0, -normalized.x(), 0.0, 1.0, -normalized.y();
  normalized_by_cam /= in_cam.z();
  jacobian->camera = cameraJacobian(camera, normalized);
  // The chain, from the camera down to the target: each line is d(pixel) / d(that frame).
  const Eigen::Matrix<double, 2, 3> by_tilted =
      camera.pixelJacobian(normalized) * normalized_by_cam * frames.cam_from_base.rotation;
  const Eigen::Matrix<double, 2, 3> by_base = by_tilted * axis_rotation;
  const Eigen::Matrix<double, 2, 3> by_moved =
      by_base * base_from_table * frames.table_from_target.rotation;
  const Eigen::Matrix<double, 2, 3> by_corrected = by_moved * target_turn;
  const Eigen::Matrix3d face_turn = rotationBy(at.face.head<3>());

  jacobian->axis.leftCols<2>() = by_tilted * turnJacobian(axis_turn, in_base).leftCols<2>();
  jacobian->axis.rightCols<2>() = by_tilted.leftCols<2>();
  jacobian->angle = by_base * Eigen::Vector3d(-in_base.y(), in_base.x(), 0.0);
  jacobian->target.leftCols<3>() = by_moved * turnJacobian(at.target.head<3>(), in_target);
  jacobian->target.rightCols<3>() = by_moved;
  jacobian->face.leftCols<3>() =
      by_corrected *
      turnJacobian(at.face.head<3>(), point.from_middle + at.page_stretch * point.stretch);
  jacobian->face.middleCols<3>(3) = by_corrected;
  jacobian->face.rightCols<3>() = by_corrected * point.normal * point.bow.transpose();
  jacobian->page_stretch = by_corrected * face_turn * point.stretch;
  jacobian->point_in_target = by_corrected;
  return true;
}

}  // namespace gyre
