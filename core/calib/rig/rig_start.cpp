// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/calib/lens/target_pose.h"
#include "core/calib/rig/axis_from_poses.h"
#include "core/calib/rig/step_scale.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr double kShortestLens = 0.3;  // focal lengths tried, in widths of the picture
constexpr double kLongestLens = 20.0;
constexpr int kLensesTried = 28;
constexpr std::size_t kViewsForLens = 8;
constexpr std::size_t kLeastSightings = 4;  // of a picture, for a pose
constexpr double kLeastTurn_rad = 0.06;     // between two pictures, to say anything of the axis
constexpr double kUpright = 0.2;            // cosine from which a target's up is the axis's up

// The sightings of one piece in one picture.
using PieceView = std::vector<KnownPoint>;

// [piece][view]; a target that is not loose is one piece.
std::vector<std::vector<PieceView>> pieceViews(const RigScene& scene, std::size_t views,
                                               TargetShape shape) {
  const bool loose = shape == TargetShape::kLooseMarkers;
  const std::size_t pieces = loose ? scene.faces.size() - 1 : 1;
  std::vector<std::vector<PieceView>> result(pieces, std::vector<PieceView>(views));
  for (const RigSighting& seen : scene.sightings) {
    const std::size_t piece = loose ? scene.face_of[seen.point] : 0;
    if (piece >= pieces) continue;  // a corner of no marker
    result[piece][seen.view].push_back({scene.points[seen.point].position_in_target, seen.pixel});
  }
  return result;
}

CameraModel middlingCamera(const RigBundleOptions& options, double focal_px) {
  CameraModel camera;
  camera.width_px = options.image_width_px;
  camera.height_px = options.image_height_px;
  camera.fx = camera.fy = focal_px;
  camera.cx = 0.5 * (options.image_width_px - 1);
  camera.cy = 0.5 * (options.image_height_px - 1);
  return camera;
}

// The views with most points, in the order of the pictures.
std::vector<const PieceView*> richest(const std::vector<std::vector<PieceView>>& pieces) {
  std::vector<const PieceView*> views;
  for (const auto& piece : pieces) {
    for (const PieceView& view : piece) {
      if (view.size() >= kLeastSightings + 2 || (view.size() >= 4 && pieces.size() > 1)) {
        views.push_back(&view);
      }
    }
  }
  std::stable_sort(views.begin(), views.end(),
                   [](const auto* a, const auto* b) { return a->size() > b->size(); });
  if (views.size() > kViewsForLens) views.resize(kViewsForLens);
  return views;
}

// Half of the misfits of single pictures, added up, as a function of the focal length alone.
double lensCost(const RigBundleOptions& options, double focal_px,
                const std::vector<const PieceView*>& views) {
  const CameraModel camera = middlingCamera(options, focal_px);
  double sum = 0.0;
  for (const PieceView* view : views) {
    const auto pose = targetPose(camera, *view);
    sum += pose ? pose->median_px : 0.05 * options.image_width_px;
  }
  return sum;
}

CameraModel firstCamera(const RigBundleOptions& options,
                        const std::vector<std::vector<PieceView>>& pieces) {
  if (options.fixed_camera) return *options.fixed_camera;
  const std::vector<const PieceView*> views = richest(pieces);
  double best_px = options.image_width_px;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kLensesTried; ++i) {
    const double focal_px =
        options.image_width_px * kShortestLens *
        std::pow(kLongestLens / kShortestLens, static_cast<double>(i) / (kLensesTried - 1));
    const double cost = lensCost(options, focal_px, views);
    if (cost >= least) continue;
    least = cost;
    best_px = focal_px;
  }
  return middlingCamera(options, best_px);
}

std::vector<PoseSeries> posesOf(const CameraModel& camera,
                                const std::vector<std::vector<PieceView>>& pieces) {
  std::vector<PoseSeries> series;
  for (const auto& piece : pieces) {
    series.emplace_back();
    for (const PieceView& view : piece) {
      const auto pose = targetPose(camera, view);
      series.back().push_back(pose ? std::optional(pose->cam_from_target) : std::nullopt);
    }
  }
  return series;
}

// The axis's direction, up: on the side to which the target's z axis, or the markers' faces, point;
// where they stand upright, up in the picture.
Eigen::Vector3d upwards(Eigen::Vector3d direction, const std::vector<PoseSeries>& series,
                        const std::vector<Eigen::Vector3d>& up_in_piece) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t piece = 0; piece < series.size(); ++piece) {
    for (const auto& pose : series[piece]) {
      if (!pose) continue;
      sum += direction.dot(pose->rotation * up_in_piece[piece]);
      count += 1.0;
    }
  }
  const double up = std::abs(sum) > kUpright * count ? sum : -direction.y();
  return up < 0.0 ? Eigen::Vector3d(-direction) : direction;
}

// A frame on the axis with z along it and x towards the camera.
Rigid3 camFromBase(const AxisInCam& axis) {
  const Eigen::Vector3d& z = axis.direction;
  Eigen::Vector3d x = -axis.point - z * z.dot(-axis.point);
  if (x.norm() < 1e-6 * (1.0 + axis.point.norm())) x = z.unitOrthogonal();
  Rigid3 cam_from_base;
  cam_from_base.rotation.col(0) = x.normalized();
  cam_from_base.rotation.col(1) = z.cross(x.normalized());
  cam_from_base.rotation.col(2) = z;
  cam_from_base.translation = axis.point;
  return cam_from_base;
}

// Of the places that the pictures give a piece on the table, the one in the midst of all.
std::optional<Rigid3> placeOf(const PoseSeries& poses, const Rigid3& cam_from_base,
                              const std::vector<double>& angles_rad) {
  std::vector<Rigid3> places;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (poses[k])
      places.push_back(camFromTable(cam_from_base, angles_rad[k]).inverse() * *poses[k]);
  }
  std::optional<Rigid3> midst;
  double least = std::numeric_limits<double>::infinity();
  for (const Rigid3& place : places) {
    double sum = 0.0;
    for (const Rigid3& other : places) {
      // 50 mm: the reach of a target, which turns an angle into a distance.
      sum += (place.translation - other.translation).norm() +
             50.0 * (place.rotation - other.rotation).norm();
    }
    if (sum >= least) continue;
    least = sum;
    midst = place;
  }
  return midst;
}

Eigen::Vector3d turnOf(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

// Puts the loose piece where the place says: exp(turn) (x - middle) + middle + shift.
Eigen::Matrix<double, kFaceSize, 1> faceAt(const Rigid3& table_from_piece,
                                           const TargetPiece& piece) {
  Eigen::Matrix<double, kFaceSize, 1> face = Eigen::Matrix<double, kFaceSize, 1>::Zero();
  face.head<3>() = turnOf(table_from_piece.rotation);
  face.segment<3>(3) = table_from_piece * piece.middle - piece.middle;
  return face;
}

Error tooFewPoses(std::size_t found) {
  return {Error::Code::kTooFew,
          found == 0 ? "No picture shows enough of the target."
                     : "Only " + std::to_string(found) +
                           " of the pictures shows enough of the "
                           "target: one view does not show how the table turns.",
          "Take more pictures, the table turned between them, with the whole target in sight."};
}

// Where the target's z axis points, or a marker's printed side: the corners go round clockwise.
std::vector<Eigen::Vector3d> upInPieces(const Target& target, TargetShape shape) {
  if (shape != TargetShape::kLooseMarkers) return {Eigen::Vector3d::UnitZ()};
  std::vector<Eigen::Vector3d> up;
  for (const TargetMarker& marker : target.markers) {
    const auto& c = marker.corners_in_target;
    up.push_back((c[3] - c[0]).cross(c[1] - c[0]).normalized());
  }
  return up;
}

// A picture that nothing places, neither command nor sight.
std::optional<Error> lostPicture(std::span<const TargetView> views, const RigScene& scene,
                                 const std::vector<std::optional<double>>& seen_rad) {
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (scene.commanded_rad[k] || seen_rad[k]) continue;
    return Error{Error::Code::kTooFew,
                 "The picture \"" + views[k].name +
                     "\" shows too little of the target to tell how far the table was turned.",
                 "Leave it out, or give the angles of the pictures."};
  }
  return std::nullopt;
}

}  // namespace

Result<RigState> startOf(std::span<const TargetView> views, const Target& target,
                         const RigScene& scene, const RigBundleOptions& options, const Task& task) {
  const auto pieces = pieceViews(scene, views.size(), options.shape);
  RigState state;
  state.frames.camera = firstCamera(options, pieces);
  if (task.stopRequested()) return cancelled();
  const std::vector<PoseSeries> series = posesOf(state.frames.camera, pieces);
  std::size_t posed = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    posed += std::any_of(series.begin(), series.end(), [&](const auto& s) { return !!s[k]; });
  }
  if (posed < 2) return tooFewPoses(posed);
  if (task.stopRequested()) return cancelled();

  auto axis = axisFromPoses(series, kLeastTurn_rad);
  if (!axis) {
    return Error{Error::Code::kTooFew, "The target stands the same way in all pictures.",
                 "Turn the table between the pictures, all around; if it was told to turn, look "
                 "whether it did."};
  }
  axis->direction = upwards(axis->direction, series, upInPieces(target, options.shape));
  state.frames.cam_from_base = camFromBase(*axis);

  const auto seen_rad = anglesFromPoses(series, axis->direction);
  if (const auto lost = lostPicture(views, scene, seen_rad)) return *lost;
  state.step_scale = stepScaleFrom(scene.commanded_rad, seen_rad).value_or(1.0);
  state.angles_rad = unwrappedAngles(scene.commanded_rad, seen_rad, state.step_scale);
  // The first picture's angle is 0 whoever was seen first.
  const double first_rad = state.angles_rad.front();
  for (double& angle_rad : state.angles_rad) angle_rad -= first_rad;

  state.faces.assign(scene.faces.size(), Eigen::Matrix<double, kFaceSize, 1>::Zero());
  for (std::size_t piece = 0; piece < series.size(); ++piece) {
    const auto place = placeOf(series[piece], state.frames.cam_from_base, state.angles_rad);
    if (!place) continue;  // never seen
    if (options.shape == TargetShape::kLooseMarkers) {
      state.faces[piece] = faceAt(*place, scene.faces[piece]);
    } else {
      state.frames.table_from_target = *place;
    }
  }
  return state;
}

}  // namespace gyre
