// From a point of the target to its pixel, through face, table, angle, axis and lens, with the
// derivative by each. The one equation that the bundle, its checks and its predictions share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/target.h"

namespace gyre {

// Sizes and order of the parameters of each block.
inline constexpr int kIntrinsics = 7;  // focal length fx, aspect fy/fx, cx, cy, k1, k2, k3 ...
inline constexpr int kTangential = 2;  // ... and p1, p2
inline constexpr int kCameraSize = kIntrinsics + kTangential;
inline constexpr int kAxisSize = 4;  // turn about the table's x and y [rad], shift along them [mm]
inline constexpr int kTargetSize = 6;  // turn [rad] and shift [mm] in the target frame
inline constexpr int kFaceSize = 9;    // turn [rad], shift and bow [mm] in the target frame

using CameraVector = Eigen::Matrix<double, kCameraSize, 1>;
CameraVector cameraVector(const CameraModel& camera);
// Image size and skew stay as the base has them.
CameraModel cameraFrom(const CameraVector& vector, CameraModel base);

// A sheet of the target, or one of its loose markers: what moves as one piece.
struct TargetPiece {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // all in the target frame, mm
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();   // unit vectors within the sheet
  Eigen::Vector3d across = Eigen::Vector3d::UnitY();  // normal = along x across
  double half_along_mm = 1.0;                         // from the middle to the rim
  double half_across_mm = 1.0;
  std::vector<int> points;  // indices into pointsOf(target)
};

// The target's faces; pieces that are no plane get the middle of their points and the frame's axes.
// Points of no face are in none.
std::vector<TargetPiece> facePiecesOf(const Target& target);
// Each marker by itself, as if it lay alone.
std::vector<TargetPiece> loosePiecesOf(const Target& target);

// One point of the target as the bundle sees it.
struct FacePoint {
  Eigen::Vector3d position_in_target = Eigen::Vector3d::Zero();
  Eigen::Vector3d from_middle = Eigen::Vector3d::Zero();  // of its face
  Eigen::Vector3d stretch = Eigen::Vector3d::Zero();      // its derivative by the page's stretch
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d bow = Eigen::Vector3d::Zero();  // weights of the three bow parameters
};
FacePoint facePoint(const Target& target, const TargetPiece& face, int face_index,
                    const Eigen::Vector3d& position_in_target);

// Where everything is. Small corrections act on these, so that they are zero when solved anew.
struct RigFrames {
  CameraModel camera;
  Rigid3 cam_from_base;
  Rigid3 table_from_target;
};

struct RigParameters {
  CameraVector camera = CameraVector::Zero();
  Eigen::Matrix<double, kAxisSize, 1> axis = Eigen::Matrix<double, kAxisSize, 1>::Zero();
  Eigen::Matrix<double, kTargetSize, 1> target = Eigen::Matrix<double, kTargetSize, 1>::Zero();
  double angle_rad = 0.0;
  Eigen::Matrix<double, kFaceSize, 1> face = Eigen::Matrix<double, kFaceSize, 1>::Zero();
  double page_stretch = 0.0;  // along the page's width over its height, less one
};

struct RigJacobian {
  Eigen::Matrix<double, 2, kCameraSize> camera;
  Eigen::Matrix<double, 2, kAxisSize> axis;
  Eigen::Vector2d angle;
  Eigen::Matrix<double, 2, kTargetSize> target;
  Eigen::Matrix<double, 2, kFaceSize> face;
  Eigen::Vector2d page_stretch;
  Eigen::Matrix<double, 2, 3> point_in_target;
};

// The pixel at which the rig shows the point; jacobian may be null. False when the point is not in
// front of the camera.
bool projectRig(const RigFrames& frames, const RigParameters& at, const FacePoint& point,
                Eigen::Vector2d* pixel, RigJacobian* jacobian);

// The point in the target frame after its face's corrections.
Eigen::Vector3d correctedInTarget(const RigParameters& at, const FacePoint& point);

// The rotation by |turn| about turn.
Eigen::Matrix3d rotationBy(const Eigen::Vector3d& turn_rad);
// d(rotationBy(w) x) / dw.
Eigen::Matrix3d turnJacobian(const Eigen::Vector3d& turn_rad, const Eigen::Vector3d& x);

}  // namespace gyre
