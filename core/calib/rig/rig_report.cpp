// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_report.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/calib/rig/angle_pattern.h"
#include "core/calib/rig/object_error.h"
#include "core/calib/rig/rig_refusals.h"
#include "core/calib/rig/rig_verdict.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr double kSteepPlane = 0.5;  // a plane nearer to the axis than 30 deg has no height on it
constexpr int kRimPoints = 64;

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Where the plane meets the z axis, or how high the point is when it hardly does.
double heightOnAxis(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  if (std::abs(normal.z()) < kSteepPlane) return point.z();
  return point.dot(normal) / normal.z();
}

double platterHeight(const RigScene& scene, TargetShape shape, const RigState& state) {
  const Rigid3& table_from_target = state.frames.table_from_target;
  if (shape != TargetShape::kLooseMarkers) {
    return heightOnAxis(table_from_target.translation, table_from_target.rotation.col(2));
  }
  std::vector<bool> seen(scene.points.size(), false);
  for (const RigSighting& sighting : scene.sightings) seen[sighting.point] = sighting.used;
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d midst = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    points.push_back(table_from_target *
                     correctedInTarget(state.at(0, scene.face_of[i]), scene.points[i]));
    midst += points.back();
  }
  midst /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& x : points) scatter += (x - midst) * (x - midst).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  return heightOnAxis(midst, eigen.eigenvectors().col(0));
}

// The farthest the rim is from the middle; positive when the middle bulges outwards.
double bowOf(const Eigen::Matrix<double, kFaceSize, 1>& face) {
  double farthest = 0.0;
  for (int i = 0; i < kRimPoints; ++i) {
    const double angle_rad = kTurn_rad * i / kRimPoints;
    const double side = std::max(std::abs(std::cos(angle_rad)), std::abs(std::sin(angle_rad)));
    const double u = std::cos(angle_rad) / side;
    const double v = std::sin(angle_rad) / side;
    const double rim = Eigen::Vector3d(u * u, u * v, v * v).dot(face.tail<3>());
    if (std::abs(rim) > std::abs(farthest)) farthest = rim;
  }
  return -farthest;
}

std::vector<FaceReport> faceReports(const RigScene& scene, const RigState& state) {
  std::vector<FaceReport> faces(scene.faces.size() - 1);
  for (const RigSighting& seen : scene.sightings) {
    const std::size_t face = scene.face_of[seen.point];
    if (seen.used && face < faces.size()) ++faces[face].points;
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto& face = state.faces[i];
    const Eigen::Vector3d turned_normal = rotationBy(face.head<3>()) * scene.faces[i].normal;
    faces[i].bow_mm = bowOf(face);
    faces[i].tilt_rad = std::atan2(scene.faces[i].normal.cross(turned_normal).norm(),
                                   scene.faces[i].normal.dot(turned_normal));
    faces[i].shift_mm = face.segment<3>(3).norm();
  }
  return faces;
}

// Residuals, counts and the figures in pixels.
void reportResiduals(const RigScene& scene, const RigState& state, CalibrationReport& report) {
  const std::vector<Eigen::Vector2d> residuals = residualsOf(scene, state);
  std::vector<double> off;
  double squares = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const RigSighting& seen = scene.sightings[i];
    report.residuals.push_back({static_cast<int>(seen.view), static_cast<int>(seen.point),
                                seen.pixel, residuals[i], seen.used});
    if (!seen.used) {
      ++report.outliers;
      continue;
    }
    off.push_back(residuals[i].norm());
    squares += residuals[i].squaredNorm();
    report.worst_px = std::max(report.worst_px, off.back());
  }
  report.sightings = residuals.size();
  report.median_px = median(off);
  if (!off.empty()) report.rms_px = std::sqrt(squares / static_cast<double>(off.size()));
}

void reportSigmas(const RigCovariance& covariance, CalibrationReport& report) {
  const auto sigma = [&](int i) { return std::sqrt(std::max(0.0, covariance.rig(i, i))); };
  report.focal_sigma_px = sigma(0);
  report.principal_sigma_px = std::max(sigma(2), sigma(3));
  report.axis_tilt_sigma_rad = std::hypot(sigma(kCameraSize), sigma(kCameraSize + 1));
  report.axis_offset_sigma_mm = std::hypot(sigma(kCameraSize + 2), sigma(kCameraSize + 3));
}

// A picture that shows nothing of the target stands where its command puts it among its neighbours:
// what the motor is off there is taken from those before and after it.
void placeUnseen(const RigScene& scene, RigState& state) {
  std::vector<bool> seen(state.angles_rad.size(), false);
  for (const RigSighting& sighting : scene.sightings) {
    if (sighting.used) seen[sighting.view] = true;
  }
  const auto off = [&](std::size_t k) {
    if (!scene.commanded_rad[k]) return 0.0;
    return state.angles_rad[k] - state.step_scale * *scene.commanded_rad[k];
  };
  for (std::size_t k = 1; k < seen.size(); ++k) {
    if (seen[k] || !scene.commanded_rad[k]) continue;
    const std::size_t before = k - 1;  // already placed
    std::size_t after = k + 1;
    while (after < seen.size() && !seen[after]) ++after;
    const double share = after < seen.size() ? 1.0 / static_cast<double>(after - before) : 0.0;
    const double off_rad =
        share > 0.0 ? (1.0 - share) * off(before) + share * off(after) : off(before);
    state.angles_rad[k] = state.step_scale * *scene.commanded_rad[k] + off_rad;
  }
}

// How large the target is in the pictures: the median, over the views, of its longer side.
double targetShare(const RigScene& scene, const RigBundleOptions& options, std::size_t views) {
  std::vector<Eigen::AlignedBox2d> boxes(views);
  for (const RigSighting& seen : scene.sightings) boxes[seen.view].extend(seen.pixel);
  std::vector<double> sides;
  for (const Eigen::AlignedBox2d& box : boxes) {
    if (!box.isEmpty()) sides.push_back(box.sizes().maxCoeff());
  }
  return median(sides) / std::min(options.image_width_px, options.image_height_px);
}

void predictErrors(const RigBundleOptions& options, const SolvedRig& solved,
                   CalibrationReport& report) {
  const ErrorProbe probe{options.object_size_mm, options.object_middle_in_table};
  const ObjectError error = predictObjectError(solved.state.frames, solved.covariance.rig, probe);
  const double target_share = options.caliper_sigma_mm
                                  ? *options.caliper_sigma_mm / options.ruler_mm
                                  : options.printer_sigma;
  report.object_size_mm = options.object_size_mm;
  report.local_detail_mm = error.detail_mm;
  report.overall_size_mm = options.object_size_mm * std::hypot(error.size_share, target_share);
  report.size_verified = options.caliper_sigma_mm.has_value();
}

Target foundTarget(const Target& target, const RigScene& scene, const RigState& state) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(scene.points.size());
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    positions.push_back(correctedInTarget(state.at(0, scene.face_of[i]), scene.points[i]));
  }
  return withPoints(target, positions);
}

}  // namespace

void settleFrames(const RigScene& scene, TargetShape shape, RigState& state) {
  RigFrames& frames = state.frames;
  const Eigen::Vector3d camera_in_base = frames.cam_from_base.inverse().translation;
  Rigid3 old_from_new = baseFromTable(std::atan2(camera_in_base.y(), camera_in_base.x()));
  old_from_new.translation.z() = platterHeight(scene, shape, state);
  frames.cam_from_base = frames.cam_from_base * old_from_new;
  frames.table_from_target = old_from_new.inverse() * frames.table_from_target;
  placeUnseen(scene, state);
}

RigCalibration resultOf(std::span<const TargetView> views, const Target& target,
                        const RigBundleOptions& options, const SolvedRig& solved) {
  const auto& [scene, state, covariance] = solved;
  RigCalibration result;
  result.calibration = {state.frames.camera, state.frames.cam_from_base};
  result.table_from_target = state.frames.table_from_target;
  result.target = foundTarget(target, scene, state);
  result.parameter_names = covariance.names;
  result.covariance = covariance.matrix;

  CalibrationReport& report = result.report;
  report.views = views.size();
  reportResiduals(scene, state, report);
  reportSigmas(covariance, report);
  predictErrors(options, solved, report);
  report.angles_rad = state.angles_rad;
  if (options.shape == TargetShape::kFreeFaces) report.faces = faceReports(scene, state);

  const AnglePattern pattern = anglePatternOf(state.angles_rad, scene.commanded_rad);
  const double step_scale = pattern.step_scale.value_or(state.step_scale);
  report.direction = step_scale < 0.0 ? -1 : 1;
  report.step_scale = std::abs(step_scale);
  report.once_per_turn = pattern.once_per_turn;
  report.twice_per_turn = pattern.twice_per_turn;

  const CaptureFacts facts{
      coveredArc(state.angles_rad), targetShare(scene, options, views.size()),
      static_cast<double>(report.outliers) / static_cast<double>(report.sightings)};
  judge(options, facts, report);
  report.remarks = remarksOn(report, facts);
  std::vector<std::string> names;
  for (const TargetView& view : views) names.push_back(view.name);
  for (std::string& sentence : sentencesOf(pattern, names)) {
    report.remarks.push_back(std::move(sentence));
  }
  return result;
}

CalibrationRecord recordOf(const RigCalibration& calibration) {
  CalibrationRecord record;
  record.calibration = calibration.calibration;
  record.target = calibration.target.name;
  record.report = calibration.report;
  record.covariance = NamedCovariance{calibration.parameter_names, calibration.covariance};
  record.table_from_target = calibration.table_from_target;
  for (const TargetPoint& point : pointsOf(calibration.target)) {
    record.points_in_target.push_back(point.position_in_target);
  }
  return record;
}

}  // namespace gyre
