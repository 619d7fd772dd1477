// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/final_cloud.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"
#include "core/mesh/point_bending.h"
#include "core/mesh/point_normals.h"
#include "core/pipeline/solved_turning.h"
#include "core/recover/turn_estimator.h"
#include "core/track/reobservation.h"

namespace gyre {
namespace {

// A track of which fewer sightings than this share are found again slid over the surface.
constexpr double kConfirmed = 0.5;
// Points are looked for where something may hide them: that many sightings may disagree.
constexpr double kMayBeHidden = 0.5;

// A point on its way into the cloud.
struct Candidate {
  const MeasuredTrack* track = nullptr;
  std::vector<Observation> observations;  // what the point is estimated from
  std::vector<Sighting> sightings;        // the same, undistorted
  std::optional<Sighting> returned;       // in the first view, of a track of the last one
  std::optional<EstimatedPoint> estimated;
};

// The middle colour of all sightings, each channel by itself: a highlight in some does no harm.
Rgb middleColour(const std::vector<Rgb>& colours) {
  Rgb middle{};
  std::vector<std::uint8_t> values(colours.size());
  for (std::size_t channel = 0; channel < middle.size(); ++channel) {
    for (std::size_t i = 0; i < colours.size(); ++i) values[i] = colours[i][channel];
    middle[channel] = median(values);
  }
  return middle;
}

class Finisher {
 public:
  Finisher(const TrackedTurn& turn, const Calibration& calibration,
           const SilhouetteRecord& silhouettes, const ReconstructOptions& options)
      : turn_(turn),
        calibration_(calibration),
        silhouettes_(silhouettes),
        options_(options),
        recover_(options.recover) {
    std::map<std::uint32_t, Sighting> returned;
    if (turn.closure) {
      for (const auto& [track_id, sighting] : turn.closure->tracks) returned[track_id] = sighting;
    }
    candidates_.reserve(turn.tracks.size());
    for (const MeasuredTrack* track : turn.tracks) {
      const auto found = returned.find(track->track.id);
      candidates_.push_back({track, track->track.observations, track->sightings,
                             found == returned.end() ? std::nullopt : std::optional(found->second),
                             std::nullopt});
    }
  }

  // Points and angles from the candidates' sightings; drops the candidates that give none.
  Result<void> estimate(const Task& task);
  // Keeps the candidates that all views believe; the cloud and its normals are theirs.
  Result<void> judge(const Task& task);
  // Gives the candidates the sightings that every view has of them; drops those that hardly any
  // view shows again.
  Result<void> reobserveAll(const Task& task);
  Reconstruction take();

 private:
  std::vector<Eigen::Vector3d> directionsToCameras() const;
  void measureResiduals();

  const TrackedTurn& turn_;
  const Calibration& calibration_;
  const SilhouetteRecord& silhouettes_;
  const ReconstructOptions& options_;
  RecoverOptions recover_;
  std::vector<Candidate> candidates_;
  std::vector<double> corrections_rad_;
  std::vector<Rigid3> poses_;  // at the angles found
  Reconstruction result_;
};

Result<void> Finisher::estimate(const Task& task) {
  // A returned track's sighting in the first view holds the ends of the turn together.
  std::vector<std::vector<Sighting>> joined(candidates_.size());
  std::vector<TrackSightings> tracks;
  tracks.reserve(candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& candidate = candidates_[i];
    const std::uint32_t seed = candidate.track->track.id;
    if (!candidate.returned) {
      tracks.push_back({candidate.sightings, seed});
      continue;
    }
    joined[i].push_back(*candidate.returned);
    joined[i].insert(joined[i].end(), candidate.sightings.begin(), candidate.sightings.end());
    tracks.push_back({joined[i], seed});
  }
  const AngleBeliefs beliefs = beliefsBeforeSolving(turn_.turning.views, recover_);
  auto solved = estimateTurn(tracks, turn_.cam_from_table, beliefs.knowledge(), recover_, task);
  if (!solved) return solved.error();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    auto& point = solved->points[i];
    if (point && candidates_[i].returned) point->agrees.erase(point->agrees.begin());
    candidates_[i].estimated = std::move(point);
  }
  corrections_rad_ = solved->corrections_rad;
  poses_ = turn_.cam_from_table;
  for (std::size_t view = 0; view < poses_.size(); ++view) {
    poses_[view] = camFromTable(poses_[view], corrections_rad_[view]);
  }
  result_.turning = afterSolving(turn_.turning, *solved);
  return {};
}

Result<void> Finisher::judge(const Task& task) {
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    return !candidate.estimated || !plausible(*candidate.estimated, options_);
  });
  PointCloud cloud;
  cloud.points.reserve(candidates_.size());
  for (const Candidate& each : candidates_) {
    cloud.points.push_back(pointOf(*each.track, each.sightings, *each.estimated));
  }
  const auto keep =
      judgePoints(cloud, silhouettes_.turned(corrections_rad_), options_.cloud, Scrutiny::kFull);
  if (task.stopRequested()) return cancelled();
  result_.cloud.points.clear();
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    result_.cloud.points.push_back(std::move(cloud.points[i]));
    kept.push_back(std::move(candidates_[i]));
  }
  candidates_ = std::move(kept);
  return setPointNormals(result_.cloud, directionsToCameras(), {}, task);
}

// For each point the mean direction to the cameras that saw it, in the table frame.
std::vector<Eigen::Vector3d> Finisher::directionsToCameras() const {
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(poses_.size());
  for (const Rigid3& pose : poses_) centres.push_back(pose.inverse().translation);
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(result_.cloud.points.size());
  for (const Point& point : result_.cloud.points) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t view : point.views) {
      sum += (centres[view] - point.position).normalized();
    }
    directions.push_back(sum);
  }
  return directions;
}

Result<void> Finisher::reobserveAll(const Task& task) {
  std::vector<GreyView> views;
  views.reserve(poses_.size());
  for (std::size_t i = 0; i < poses_.size(); ++i) views.push_back({turn_.greys[i], poses_[i]});
  std::vector<SurfacePoint> points;
  points.reserve(candidates_.size());
  const std::vector<Eigen::Matrix3d> bending = pointBending(result_.cloud);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Point& point = result_.cloud.points[i];
    points.push_back({point.position, point.normal, bending[i], point.views});
  }
  auto seen = reobserve(calibration_.camera, views, points, options_.track, task);
  if (!seen) return seen.error();
  const CameraModel& camera = calibration_.camera;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    std::vector<Observation>& found = (*seen)[i];
    Candidate& candidate = candidates_[i];
    if (static_cast<double>(found.size()) < kConfirmed * candidate.estimated->agreeing) {
      candidate.track = nullptr;
      continue;
    }
    candidate.returned.reset();
    candidate.sightings.clear();
    for (const Observation& each : found) {
      candidate.sightings.push_back({each.view, camera.normalizedFromPixel(each.pixel),
                                     each.sigma_px / std::sqrt(camera.fx * camera.fy)});
    }
    candidate.observations = std::move(found);
  }
  std::erase_if(candidates_, [](const Candidate& each) { return each.track == nullptr; });
  recover_.min_agreeing = std::min(recover_.min_agreeing, 1.0 - kMayBeHidden);
  return {};
}

void Finisher::measureResiduals() {
  std::vector<double> distances_px;
  double squares = 0.0;
  double ray_distances_mm = 0.0;
  for (const Candidate& candidate : candidates_) {
    const Eigen::Vector3d& position = candidate.estimated->position_in_table;
    for (std::size_t i = 0; i < candidate.sightings.size(); ++i) {
      if (candidate.estimated->agrees[i] == 0) continue;
      const Observation& seen = candidate.observations[i];
      const Rigid3& pose = poses_[static_cast<std::size_t>(seen.view)];
      const auto pixel = calibration_.camera.project(pose * position);
      if (!pixel) continue;
      distances_px.push_back((*pixel - seen.pixel).norm());
      squares += distances_px.back() * distances_px.back();
      ray_distances_mm +=
          distanceToLine(rayThrough(pose, candidate.sightings[i].normalized), position);
    }
  }
  result_.observations = distances_px.size();
  if (distances_px.empty()) return;
  const auto count = static_cast<double>(distances_px.size());
  result_.ray_distance_mm = ray_distances_mm / count;
  result_.rms_px = std::sqrt(squares / count);
  result_.median_px = median(std::move(distances_px));
}

Reconstruction Finisher::take() {
  measureResiduals();
  if (turn_.closure) result_.turn_gap = turn_.closure->gap;
  return std::move(result_);
}

}  // namespace

bool plausible(const EstimatedPoint& estimated, const ReconstructOptions& options) {
  // The platter's own texture scatters about its height: a point must be clearly above it.
  const double z_sigma = std::sqrt(estimated.covariance(2, 2));
  return estimated.agreeing >= options.recover.min_views &&
         estimated.chi2_per_freedom <= options.cloud.max_chi2 &&
         estimated.position_in_table.z() - 2.0 * z_sigma >= options.track.min_height_mm;
}

Point pointOf(const MeasuredTrack& track, std::span<const Sighting> sightings,
              const EstimatedPoint& estimated) {
  Point point;
  point.position = estimated.position_in_table;
  point.covariance = estimated.covariance;
  point.rgb = middleColour(track.colours);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (estimated.agrees[i] != 0) {
      point.views.push_back(static_cast<std::uint32_t>(sightings[i].view));
    }
  }
  return point;
}

Result<Reconstruction> finalCloud(const TrackedTurn& turn, const Calibration& calibration,
                                  const SilhouetteRecord& silhouettes,
                                  const ReconstructOptions& options, const Task& task) {
  Finisher finisher(turn, calibration, silhouettes, options);
  const double start_s = steadySeconds();
  if (auto done = finisher.estimate(task.part(0.0, 0.3)); !done) return done.error();
  if (auto done = finisher.judge(task.part(0.3, 0.4)); !done) return done.error();
  const double first_s = steadySeconds();
  if (auto done = finisher.reobserveAll(task.part(0.4, 0.7)); !done) return done.error();
  const double seen_s = steadySeconds();
  if (auto done = finisher.estimate(task.part(0.7, 0.9)); !done) return done.error();
  if (auto done = finisher.judge(task.part(0.9, 1.0)); !done) return done.error();
  Reconstruction result = finisher.take();
  result.seconds["reobserve"] = seen_s - first_s;
  result.seconds["recover"] = first_s - start_s + (steadySeconds() - seen_s);
  return result;
}

}  // namespace gyre
