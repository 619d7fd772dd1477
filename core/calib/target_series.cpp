// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/target_series.h"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/units.h"

namespace gyre {
namespace {

// Less than this tells neither axis nor rate.
constexpr double kLeastTurn_rad = radFromDeg(2.0);

}  // namespace

TargetSeries::TargetSeries(Target target, FindTargetOptions options)
    : target_(std::move(target)), options_(std::move(options)) {}

std::optional<Rigid3> TargetSeries::expected(std::optional<double> table_angle_rad) const {
  if (!last_) return options_.expected_cam_from_target;
  Rigid3 expected = last_->cam_from_target;
  if (turn_in_target_ && table_angle_rad && last_->table_angle_rad) {
    const Eigen::Vector3d turn = (*table_angle_rad - *last_->table_angle_rad) * *turn_in_target_;
    if (turn.norm() > 0.0) {
      // Only the way round decides between labellings; where the axis is, is not needed.
      expected.rotation *= Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
  }
  return expected;
}

void TargetSeries::learn(const Solved& now) {
  if (last_ && last_->table_angle_rad && now.table_angle_rad) {
    const double commanded_rad = *now.table_angle_rad - *last_->table_angle_rad;
    const Eigen::AngleAxisd turn(last_->cam_from_target.rotation.transpose() *
                                 now.cam_from_target.rotation);
    if (turn.angle() > kLeastTurn_rad && std::abs(commanded_rad) > 1e-6) {
      turn_in_target_ = turn.angle() / commanded_rad * turn.axis();
    }
  }
  last_ = now;
}

Result<FoundTarget> TargetSeries::add(const cv::Mat& image, const std::string& name,
                                      std::optional<double> table_angle_rad, const Task& task) {
  FindTargetOptions options = options_;
  options.expected_cam_from_target = expected(table_angle_rad);
  auto found = findTarget(image, target_, options, task);
  if (!found) return found;
  found->view.name = name;
  found->view.table_angle_rad = table_angle_rad;
  if (found->cam_from_target) learn({*found->cam_from_target, table_angle_rad});
  return found;
}

Result<std::vector<Result<FoundTarget>>> findTargets(const std::vector<SeriesPicture>& pictures,
                                                     const Target& target,
                                                     const FindTargetOptions& options,
                                                     const Task& task) {
  TargetSeries series(target, options);
  std::vector<Result<FoundTarget>> results;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(pictures.size()),
                "Searching the target in " + pictures[i].name);
    const auto image = pictures[i].open();
    if (!image) {
      results.emplace_back(image.error());
      continue;
    }
    results.push_back(series.add(*image, pictures[i].name, pictures[i].table_angle_rad, task));
  }
  if (task.stopRequested()) return cancelled();
  return results;
}

}  // namespace gyre
