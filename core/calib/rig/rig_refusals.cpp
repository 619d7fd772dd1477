// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_refusals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr double kSamePlace_rad = radFromDeg(1.0);  // nearer angles count as one
constexpr double kThin = 0.05;       // thickness over width of what counts as a plane
constexpr double kAlongAxis = 0.97;  // cosine of 14 deg between normal and axis

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> withinTurn(const std::vector<double>& angles_rad) {
  std::vector<double> sorted;
  sorted.reserve(angles_rad.size());
  for (const double angle : angles_rad) {
    sorted.push_back(angle - kTurn_rad * std::floor(angle / kTurn_rad));
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::size_t differentAngles(const std::vector<double>& angles_rad) {
  const std::vector<double> sorted = withinTurn(angles_rad);
  std::size_t count = 0;
  double last_rad = -kTurn_rad;
  for (const double angle : sorted) {
    if (angle - last_rad < kSamePlace_rad) continue;
    last_rad = angle;
    ++count;
  }
  // The last may be the first again, a whole turn on.
  const bool closes = count > 1 && sorted.front() + kTurn_rad - last_rad < kSamePlace_rad;
  return closes ? count - 1 : count;
}

std::vector<double> anglesOfSeenViews(const RigScene& scene, const RigState& state) {
  std::vector<bool> seen(state.angles_rad.size(), false);
  for (const RigSighting& sighting : scene.sightings) seen[sighting.view] = true;
  std::vector<double> angles;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (seen[k]) angles.push_back(state.angles_rad[k]);
  }
  return angles;
}

// What the commands asked for, when there are any.
std::optional<double> commandedSpan(const RigScene& scene) {
  double least = 0.0;
  double most = 0.0;
  for (const auto& commanded : scene.commanded_rad) {
    if (!commanded) return std::nullopt;
    least = std::min(least, *commanded);
    most = std::max(most, *commanded);
  }
  return most - least;
}

}  // namespace

Result<void> checkViews(std::span<const TargetView> views, const Target& target,
                        const RigBundleOptions& options) {
  const auto points = static_cast<int>(pointsOf(target).size());
  if (points == 0 || (options.shape == TargetShape::kLooseMarkers && target.markers.empty())) {
    return Error{Error::Code::kInvalidInput,
                 "The target \"" + target.name + "\" has nothing that could be seen.",
                 "Give a target with corners or markers."};
  }
  std::size_t seen = 0;
  for (const TargetView& view : views) {
    seen += !view.sightings.empty();
    const bool bad_angle = view.table_angle_rad && !std::isfinite(*view.table_angle_rad);
    const bool bad_point =
        std::any_of(view.sightings.begin(), view.sightings.end(), [&](const PointSighting& s) {
          return s.point < 0 || s.point >= points || !s.pixel.allFinite() ||
                 !std::isfinite(s.sigma_px) || !(s.sigma_px > 0.0);
        });
    if (!bad_angle && !bad_point) continue;
    return Error{Error::Code::kInvalidInput,
                 "What is known of the picture \"" + view.name +
                     "\" has a number that cannot be, or a point that the target has not.",
                 "Find the target in the pictures again."};
  }
  if (seen >= 2) return {};
  return Error{Error::Code::kTooFew,
               seen == 0 ? "No picture shows the target."
                         : "Only one picture shows the target: one view does not show how the "
                           "table turns.",
               "Take pictures all around a turn of the table, with the target in sight."};
}

double coveredArc(const std::vector<double>& angles_rad) {
  if (angles_rad.empty()) return 0.0;
  const std::vector<double> sorted = withinTurn(angles_rad);
  double gap_rad = sorted.front() + kTurn_rad - sorted.back();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    gap_rad = std::max(gap_rad, sorted[i] - sorted[i - 1]);
  }
  return kTurn_rad - gap_rad;
}

Result<void> checkArc(const RigScene& scene, const RigState& state,
                      const RigBundleOptions& options) {
  const std::vector<double> angles = anglesOfSeenViews(scene, state);
  const double arc_rad = coveredArc(angles);
  const std::size_t different = differentAngles(angles);
  if (arc_rad >= options.min_arc_rad && different >= options.min_views) return {};
  std::string what = formatted(
      "The target is seen at %zu different angles over %.1f deg; at least %zu over %.0f deg "
      "are needed.",
      different, degFromRad(arc_rad), options.min_views, degFromRad(options.min_arc_rad));
  const auto told_rad = commandedSpan(scene);
  const double turned = std::abs(state.step_scale);
  if (told_rad && *told_rad >= options.min_arc_rad && turned < 0.5) {
    return Error{
        Error::Code::kTooFew,
        what + formatted(" The table was told to turn %.0f deg but turned %.4f times as far.",
                         degFromRad(*told_rad), turned),
        "Correct the steps per turn of the motor, and take the pictures again."};
  }
  return Error{Error::Code::kTooFew, what,
               "Take pictures all around a turn, about every 15 deg, with the target in sight."};
}

Result<void> checkNotFlat(const RigScene& scene, const RigState& state,
                          const RigBundleOptions& options) {
  if (options.fixed_camera) return {};
  std::vector<bool> seen(scene.points.size(), false);
  for (const RigSighting& sighting : scene.sightings) seen[sighting.point] = true;
  std::vector<Eigen::Vector3d> in_table;
  Eigen::Vector3d midst = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    in_table.push_back(state.frames.table_from_target *
                       correctedInTarget(state.at(0, scene.face_of[i]), scene.points[i]));
    midst += in_table.back();
  }
  midst /= static_cast<double>(in_table.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& x : in_table) scatter += (x - midst) * (x - midst).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  const double thickness = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
  const double width = std::sqrt(eigen.eigenvalues()[1]);
  const double along_axis = std::abs(eigen.eigenvectors().col(0).z());
  if (thickness > kThin * width || along_axis < kAlongAxis) return {};
  return Error{Error::Code::kInvalidInput,
               "The target lies flat on the table: turned about its own normal it cannot show the "
               "camera's focal length and centre.",
               "Stand it on the wedge or use the cube; or give the camera's intrinsics "
               "(--intrinsics FILE), with which a flat target will do."};
}

Error anotherTarget(const std::string& target_name, double median_px) {
  return {Error::Code::kInvalidInput,
          "The pictures do not fit the target \"" + target_name +
              formatted("\": half of its points are more than %.1f px off.", median_px),
          "Choose the target that is on the table, and look whether it stood firmly on it."};
}

Result<void> checkFits(const RigScene& scene, const RigState& state,
                       const RigBundleOptions& options, const std::string& target_name) {
  std::vector<double> off;
  for (const Eigen::Vector2d& residual : residualsOf(scene, state)) off.push_back(residual.norm());
  const double median_px = median(off);
  if (median_px <= options.max_median_px) return {};
  return anotherTarget(target_name, median_px);
}

}  // namespace gyre
