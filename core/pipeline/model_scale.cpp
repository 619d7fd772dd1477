// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/model_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/track/options.h"

namespace gyre {
namespace {

constexpr int kDirections = 1000;  // over a half sphere: about 4.5 degrees apart, 0.1 % of a length
constexpr double kStray = 0.001;   // of the points, at either end
constexpr double kClearance_mm = 0.5;
// What counts as a platter: a layer so thin, of the object's length, in so low a part of its
// height, with such a share of the points, that reaches further out than the rest by so much.
constexpr double kThin = 0.005;
constexpr double kFoot = 0.15;
constexpr double kLeastLayer = 0.1;
constexpr double kMostLayer = 0.95;
constexpr double kWider = 1.1;
constexpr double kMostReach = 0.95;
constexpr double kGoldenAngle_rad = 2.399963229728653;

// Least and greatest coordinate (0, 0 for no points) along a direction, but for stray points.
std::pair<double, double> extent(std::span<const Eigen::Vector3d> points,
                                 const Eigen::Vector3d& direction, std::vector<double>& buffer) {
  if (points.empty()) return {0.0, 0.0};
  buffer.clear();
  for (const Eigen::Vector3d& point : points) buffer.push_back(direction.dot(point));
  const auto stray = static_cast<std::ptrdiff_t>(kStray * static_cast<double>(buffer.size()));
  std::nth_element(buffer.begin(), buffer.begin() + stray, buffer.end());
  const double least = buffer[static_cast<std::size_t>(stray)];
  std::nth_element(buffer.begin(), buffer.end() - 1 - stray, buffer.end());
  return {least, *(buffer.end() - 1 - stray)};
}

double longestLine(std::span<const Eigen::Vector3d> points) {
  double longest = 0.0;
  std::vector<double> buffer;
  buffer.reserve(points.size());
  for (int i = 0; i < kDirections; ++i) {
    const double z = (i + 0.5) / kDirections;  // evenly over the half sphere
    const double r = std::sqrt(1.0 - z * z);
    const double turn_rad = kGoldenAngle_rad * i;
    const auto [least, most] =
        extent(points, {r * std::cos(turn_rad), r * std::sin(turn_rad), z}, buffer);
    longest = std::max(longest, most - least);
  }
  return longest;
}

// How far from the axis all but a twentieth of the points are.
double reachOf(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return 0.0;
  std::vector<double> radii;
  radii.reserve(points.size());
  for (const Eigen::Vector3d& point : points) radii.push_back(point.head<2>().norm());
  const auto place = radii.begin() + static_cast<std::ptrdiff_t>(
                                         kMostReach * static_cast<double>(radii.size() - 1));
  std::nth_element(radii.begin(), place, radii.end());
  return *place;
}

// The thin layer at the foot that holds the most points: its first and last place among points in
// the order of their heights.
std::pair<std::size_t, std::size_t> footLayer(std::span<const Eigen::Vector3d> by_height,
                                              double thickness) {
  const double foot =
      by_height.front().z() + kFoot * (by_height.back().z() - by_height.front().z());
  std::pair<std::size_t, std::size_t> most{0, 0};
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= by_height.size(); ++end) {
    while (by_height[end - 1].z() - by_height[begin].z() > thickness) ++begin;
    if (by_height[begin].z() > foot) break;
    if (end - begin > most.second - most.first) most = {begin, end};
  }
  return most;
}

}  // namespace

Placement placementOf(std::span<const Eigen::Vector3d> points_in_table) {
  if (points_in_table.empty()) return {};
  std::vector<double> buffer;
  const double lowest = extent(points_in_table, Eigen::Vector3d::UnitZ(), buffer).first;
  std::vector<Eigen::Vector3d> by_height;
  for (const Eigen::Vector3d& point : points_in_table) {
    if (point.z() >= lowest) by_height.push_back(point);
  }
  std::sort(by_height.begin(), by_height.end(),
            [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.z() < b.z(); });
  const double length = longestLine(by_height);
  const auto [begin, end] = footLayer(by_height, kThin * length);
  const std::span<const Eigen::Vector3d> all(by_height);
  const auto layer = all.subspan(begin, end - begin);
  const auto above = all.subspan(end);
  const auto share = static_cast<double>(layer.size()) / static_cast<double>(all.size());
  if (share > kLeastLayer && share < kMostLayer && reachOf(layer) > kWider * reachOf(above)) {
    return {longestLine(above), layer[layer.size() / 2].z(), true};
  }
  return {length, lowest, false};
}

void scaleCalibration(Calibration& calibration, const Placement& placement, double length_mm) {
  const double scale = placement.length > 0.0 ? length_mm / placement.length : 1.0;
  const double lift_mm =
      placement.platter_seen ? 0.0 : TrackOptions{}.min_height_mm + kClearance_mm;
  // x_new = scale * (x_old - lowest) + lift; the camera's frame is scaled as well.
  const double rise_mm = scale * placement.lowest - lift_mm;
  Rigid3& pose = *calibration.cam_from_table;
  pose.translation = scale * pose.translation + rise_mm * pose.rotation.col(2);
}

double scaleModel(Reconstruction& model, Calibration& calibration, double length_mm) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(model.cloud.points.size());
  for (const Point& point : model.cloud.points) positions.push_back(point.position);
  const double length = longestLine(positions);
  if (!(length > 0.0)) return 1.0;
  const double scale = length_mm / length;
  for (Point& point : model.cloud.points) {
    point.position *= scale;
    point.covariance *= scale * scale;
  }
  model.ray_distance_mm *= scale;
  if (model.turn_gap) model.turn_gap->mm *= scale;
  calibration.cam_from_table->translation *= scale;
  return scale;
}

}  // namespace gyre
