// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/targets/ruler_scale.h"

#include <cmath>
#include <string>
#include <vector>

namespace gyre {
namespace {

constexpr double kMostOff = 0.10;

Result<void> checkReading(double measured_mm, double nominal_mm) {
  if (!std::isfinite(measured_mm) || !std::isfinite(nominal_mm) || nominal_mm <= 0.0 ||
      measured_mm <= 0.0) {
    return Error{Error::Code::kInvalidInput, "The reading of a ruler is not a length.",
                 "Type what the caliper shows, in millimetres."};
  }
  if (std::abs(measured_mm / nominal_mm - 1.0) <= kMostOff) return {};
  return Error{Error::Code::kInvalidInput,
               "The caliper's reading is more than 10 % off what the ruler is printed to be.",
               "Measure between the two end marks again; if the sheet really came out that "
               "small or large, print it at 100 % without fitting it to the page."};
}

// Stretches one face about the middle of its points.
class Stretch {
 public:
  Stretch(const PageAxes& axes, double right, double down)
      : right_(axes.right_in_target),
        down_(axes.down_in_target),
        more_right_(right - 1.0),
        more_down_(down - 1.0) {}

  Eigen::Vector3d operator()(const Eigen::Vector3d& point, const Eigen::Vector3d& middle) const {
    const Eigen::Vector3d from_middle = point - middle;
    return point + more_right_ * right_.dot(from_middle) * right_ +
           more_down_ * down_.dot(from_middle) * down_;
  }

 private:
  Eigen::Vector3d right_;
  Eigen::Vector3d down_;
  double more_right_;
  double more_down_;
};

}  // namespace

Result<Target> scaledByRulers(const Target& target, const RulerReading& reading) {
  for (const double measured_mm : {reading.right_mm, reading.down_mm}) {
    if (auto valid = checkReading(measured_mm, reading.nominal_mm); !valid) return valid.error();
  }
  const double right = reading.right_mm / reading.nominal_mm;
  const double down = reading.down_mm / reading.nominal_mm;
  const double even = 0.5 * (right + down);

  const std::vector<TargetPoint> points = pointsOf(target);
  std::vector<Eigen::Vector3d> middle(target.faces.size(), Eigen::Vector3d::Zero());
  std::vector<double> members(target.faces.size(), 0.0);
  for (const TargetPoint& point : points) {
    if (point.face < 0) continue;
    middle[static_cast<std::size_t>(point.face)] += point.position_in_target;
    members[static_cast<std::size_t>(point.face)] += 1.0;
  }
  for (std::size_t face = 0; face < middle.size(); ++face) {
    if (members[face] > 0.0) middle[face] /= members[face];
  }
  const auto stretched = [&](const TargetPoint& point) -> Eigen::Vector3d {
    const auto face = static_cast<std::size_t>(point.face);
    if (point.face < 0 || face >= target.page_axes.size()) return even * point.position_in_target;
    // The middle itself moves as the whole target grows.
    return Stretch(target.page_axes[face], right, down)(point.position_in_target, middle[face]) +
           (even - 1.0) * middle[face];
  };
  Target scaled = target;
  std::size_t next = 0;
  for (TargetCorner& corner : scaled.corners) {
    corner.position_in_target = stretched(points[next++]);
  }
  for (TargetMarker& marker : scaled.markers) {
    for (Eigen::Vector3d& corner : marker.corners_in_target) corner = stretched(points[next++]);
  }
  return scaled;
}

}  // namespace gyre
