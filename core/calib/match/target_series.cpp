// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_series.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/units.h"

namespace gyre {
namespace {

// Less than this tells neither axis nor rate.
constexpr double kLeastTurn_rad = radFromDeg(2.0);

// What one picture allows: the poses under all labellings that fit it equally well.
struct Candidates {
  std::size_t picture = 0;
  std::optional<double> table_angle_rad;
  std::vector<Rigid3> cam_from_target;
};

// One choice of labellings through the series, from one of those of its first picture.
struct Track {
  std::vector<std::size_t> chosen;  // index into the candidates' poses
  double cost = 0.0;                // how far it is from a turn about z, rad^2
};

Eigen::AngleAxisd turnBetween(const Rigid3& from, const Rigid3& to) {
  return Eigen::AngleAxisd(from.rotation.transpose() * to.rotation);
}

Track follow(const std::vector<Candidates>& series, std::size_t first) {
  Track track;
  track.chosen.push_back(first);
  std::optional<Eigen::Vector3d> turn_a_radian;  // axis times radians turned a radian commanded
  for (std::size_t i = 1; i < series.size(); ++i) {
    const Rigid3& last = series[i - 1].cam_from_target[track.chosen.back()];
    Eigen::Matrix3d expected = last.rotation;
    std::optional<double> commanded_rad;
    if (series[i].table_angle_rad && series[i - 1].table_angle_rad) {
      commanded_rad = *series[i].table_angle_rad - *series[i - 1].table_angle_rad;
    }
    if (turn_a_radian && commanded_rad) {
      const Eigen::Vector3d turn = *commanded_rad * *turn_a_radian;
      if (turn.norm() > 0.0) {
        expected = expected * Eigen::AngleAxisd(turn.norm(), turn.normalized());
      }
    }
    std::size_t nearest = 0;
    double least_rad = 1e9;
    for (std::size_t k = 0; k < series[i].cam_from_target.size(); ++k) {
      const Eigen::Matrix3d off = expected.transpose() * series[i].cam_from_target[k].rotation;
      const double off_rad = Eigen::AngleAxisd(off).angle();
      if (off_rad >= least_rad) continue;
      least_rad = off_rad;
      nearest = k;
    }
    track.chosen.push_back(nearest);
    const Eigen::AngleAxisd turn = turnBetween(last, series[i].cam_from_target[nearest]);
    // The part of the turn that is not about z.
    track.cost += std::pow(turn.angle(), 2) * turn.axis().head<2>().squaredNorm();
    if (turn_a_radian) track.cost += least_rad * least_rad;
    if (commanded_rad && std::abs(*commanded_rad) > 1e-6 && turn.angle() > kLeastTurn_rad) {
      turn_a_radian = turn.angle() / *commanded_rad * turn.axis();
    }
  }
  return track;
}

// The choice that turns most nearly about z; of equals the first.
Track bestTrack(const std::vector<Candidates>& series) {
  constexpr double kEqual = 1e-4;
  Track best = follow(series, 0);
  for (std::size_t first = 1; first < series.front().cam_from_target.size(); ++first) {
    Track track = follow(series, first);
    if (track.cost < best.cost - kEqual) best = std::move(track);
  }
  return best;
}

Result<FoundTarget> findIn(const SeriesPicture& picture, const Target& target,
                           const FindTargetOptions& options, const Task& task) {
  const auto image = picture.open();
  if (!image) return image.error();
  auto found = findTarget(*image, target, options, task);
  if (!found) return found;
  found->view.name = picture.name;
  found->view.table_angle_rad = picture.table_angle_rad;
  return found;
}

}  // namespace

Result<std::vector<Result<FoundTarget>>> findTargets(const std::vector<SeriesPicture>& pictures,
                                                     const Target& target,
                                                     const FindTargetOptions& options,
                                                     const Task& task) {
  std::vector<Result<FoundTarget>> results;
  std::vector<Candidates> series;
  bool ambiguous = false;
  const auto total = static_cast<double>(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(0.7 * static_cast<double>(i) / total,
                "Searching the target in " + pictures[i].name);
    results.push_back(findIn(pictures[i], target, options, task));
    if (!results.back() || !results.back()->cam_from_target) continue;
    const FoundTarget& found = *results.back();
    Candidates candidates{i, pictures[i].table_angle_rad, {*found.cam_from_target}};
    candidates.cam_from_target.insert(candidates.cam_from_target.end(),
                                      found.other_cam_from_target.begin(),
                                      found.other_cam_from_target.end());
    ambiguous |= !found.other_cam_from_target.empty();
    series.push_back(std::move(candidates));
  }
  if (!ambiguous || series.size() < 2) return results;
  const Track track = bestTrack(series);
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    if (track.chosen[i] == 0) continue;
    const SeriesPicture& picture = pictures[series[i].picture];
    task.report(0.7 + 0.3 * static_cast<double>(i) / total, "Naming the points in " + picture.name);
    FindTargetOptions expecting = options;
    expecting.expected_cam_from_target = series[i].cam_from_target[track.chosen[i]];
    results[series[i].picture] = findIn(picture, target, expecting, task);
  }
  if (task.stopRequested()) return cancelled();
  return results;
}

}  // namespace gyre
