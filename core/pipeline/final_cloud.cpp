// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/final_cloud.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/base/units.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"
#include "core/mesh/point_normals.h"
#include "core/mesh/point_scatter.h"
#include "core/mesh/point_surface.h"
#include "core/pipeline/densify.h"
#include "core/pipeline/sighting_weights.h"
#include "core/pipeline/solved_turning.h"
#include "core/recover/turn_estimator.h"
#include "core/track/reobservation.h"

namespace gyre {
namespace {

// A track of which fewer sightings than this share are found again slid over the surface; but only
// where so many points are found again that the surface is known well enough to say so. From few
// views it is not.
constexpr double kConfirmed = 0.5;
constexpr double kKnownSurface = 0.8;
// Points are looked for where something may hide them: that many sightings may disagree.
constexpr double kMayBeHidden = 0.5;

// Within so many sides of a patch neighbours disagree by their errors; further away by the object's
// shape.
constexpr double kFewPatches = 2.5;
// Points nearer than this share of a patch err alike. Simulated, where the truth is known: the
// error bars of duck, mouse and vase then hold what they promise.
constexpr double kErrAlike = 0.22;
// Points are looked for once more while the angles still move by more than this: where they were
// far off, the ends of the turn did not find each other at once.
constexpr double kSettled_rad = radFromDeg(0.05);
constexpr int kMostRounds = 3;

// By how much the angles moved, but for a turn of all together, which only turns the model. [rad]
double furthest(const std::vector<double>& before, const std::vector<double>& after) {
  double common = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) common += after[i] - before[i];
  common /= static_cast<double>(std::max<std::size_t>(1, before.size()));
  double most = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, std::abs(after[i] - before[i] - common));
  }
  return most;
}

// Where a point is that was looked for around its place: its sightings are all near it.
std::optional<Eigen::Vector3d> seenAgain(const Candidate& candidate) {
  if (!candidate.estimated) return std::nullopt;
  return candidate.estimated->position_in_table;
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
      candidates_.push_back(Candidate::ofTrack(
          *track, found == returned.end() ? std::nullopt : std::optional(found->second)));
    }
  }

  // Points and angles from the candidates' sightings.
  Result<void> estimate(const Task& task);
  // Drops the candidates without a plausible point; the cloud and its normals are the others'.
  Result<void> gather(const Task& task);
  // Keeps what all views believe, once and at the end: points that are judged give each other
  // company.
  Result<void> judge(const Task& task);
  // Gives the candidates the sightings that every view has of them; drops those that hardly any
  // view shows again.
  Result<void> reobserveAll(const Task& task);
  // Adds points between those that are known.
  Result<void> densifyCloud(const Task& task);
  const std::vector<double>& correctionsRad() const { return corrections_rad_; }
  Reconstruction take();

 private:
  std::vector<Eigen::Vector3d> directionsToCameras() const;
  std::vector<GreyView> viewsAtPoses() const;
  PointEstimator estimatorAtPoses(std::span<const double> angle_sigma_rad) const;
  void gatherSightings();  // with their residuals
  void widenByScatter();
  void believeAsTheyAgree(const AngleBeliefs& beliefs);

  const TrackedTurn& turn_;
  const Calibration& calibration_;
  const SilhouetteRecord& silhouettes_;
  const ReconstructOptions& options_;
  RecoverOptions recover_;
  std::vector<Candidate> candidates_;
  std::vector<double> corrections_rad_;  // of the angles, with their standard deviations
  std::vector<double> sigma_rad_;
  std::vector<Rigid3> poses_;  // at the angles found
  double least_sigma_ = 0.0;   // of a sighting, over the focal length
  Reconstruction result_;
};

PointEstimator Finisher::estimatorAtPoses(std::span<const double> angle_sigma_rad) const {
  PointEstimator estimator = PointEstimator::create(recover_).value();
  for (std::size_t view = 0; view < turn_.cam_from_table.size(); ++view) {
    estimator.addPose(poses_.empty() ? turn_.cam_from_table[view] : poses_[view],
                      angle_sigma_rad[view]);
  }
  return estimator;
}

// No sighting is believed to be better than it agrees with others.
void Finisher::believeAsTheyAgree(const AngleBeliefs& beliefs) {
  const CameraModel& camera = calibration_.camera;
  least_sigma_ = sightingScatter(candidates_, estimatorAtPoses(beliefs.expected_sigma_rad),
                                 std::sqrt(camera.fx * camera.fy));
  for (Candidate& candidate : candidates_) {
    for (Sighting& each : candidate.sightings) each.sigma = std::max(each.sigma, least_sigma_);
    if (candidate.returned) {
      candidate.returned->sigma = std::max(candidate.returned->sigma, least_sigma_);
    }
  }
}

Result<void> Finisher::estimate(const Task& task) {
  AngleBeliefs beliefs = beliefsBeforeSolving(turn_.turning.views, recover_);
  if (!corrections_rad_.empty()) {  // solved once already
    beliefs.start_rad = corrections_rad_;
    beliefs.expected_sigma_rad = sigma_rad_;
  }
  believeAsTheyAgree(beliefs);
  // A returned track's sighting in the first view holds the ends of the turn together.
  std::vector<std::vector<Sighting>> joined(candidates_.size());
  std::vector<TrackSightings> tracks;
  tracks.reserve(candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& candidate = candidates_[i];
    if (!candidate.returned) {
      tracks.push_back({candidate.sightings, candidate.seed, seenAgain(candidate)});
      continue;
    }
    joined[i].push_back(*candidate.returned);
    joined[i].insert(joined[i].end(), candidate.sightings.begin(), candidate.sightings.end());
    tracks.push_back({joined[i], candidate.seed});
  }
  auto solved = estimateTurn(tracks, turn_.cam_from_table, beliefs.knowledge(), recover_, task);
  if (!solved) return solved.error();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    auto& point = solved->points[i];
    if (point && candidates_[i].returned) point->agrees.erase(point->agrees.begin());
    candidates_[i].estimated = std::move(point);
  }
  corrections_rad_ = solved->corrections_rad;
  sigma_rad_ = solved->sigma_rad;
  poses_ = turn_.cam_from_table;
  for (std::size_t view = 0; view < poses_.size(); ++view) {
    poses_[view] = camFromTable(poses_[view], corrections_rad_[view]);
  }
  result_.turning = afterSolving(turn_.turning, *solved);
  return {};
}

Result<void> Finisher::gather(const Task& task) {
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    return !candidate.estimated || !plausible(*candidate.estimated, options_);
  });
  result_.cloud.points.clear();
  result_.cloud.points.reserve(candidates_.size());
  for (const Candidate& each : candidates_) {
    result_.cloud.points.push_back(pointOf(each.rgb, each.sightings, *each.estimated));
  }
  return setPointNormals(result_.cloud, directionsToCameras(), {}, task);
}

Result<void> Finisher::judge(const Task& task) {
  const auto keep = judgePoints(result_.cloud, silhouettes_.turned(corrections_rad_),
                                options_.cloud, Scrutiny::kFull);
  if (task.stopRequested()) return cancelled();
  PointCloud cloud;
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    cloud.points.push_back(std::move(result_.cloud.points[i]));
    kept.push_back(std::move(candidates_[i]));
  }
  result_.cloud = std::move(cloud);
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

std::vector<GreyView> Finisher::viewsAtPoses() const {
  std::vector<GreyView> views;
  views.reserve(poses_.size());
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    views.push_back({turn_.kept[i].grey, poses_[i], turn_.kept[i].noise_sigma});
  }
  return views;
}

Result<void> Finisher::reobserveAll(const Task& task) {
  std::vector<SurfacePoint> points;
  points.reserve(candidates_.size());
  const std::vector<PointSurface> surfaces = pointSurfaces(result_.cloud);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Point& point = result_.cloud.points[i];
    points.push_back({point.position, point.normal, surfaces[i].bending, point.views});
  }
  auto seen = reobserve(calibration_.camera, viewsAtPoses(), points, options_.track, task);
  if (!seen) return seen.error();
  std::vector<char> confirmed(candidates_.size(), 0);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const auto found = static_cast<double>((*seen)[i].size());
    confirmed[i] = found >= kConfirmed * candidates_[i].estimated->agreeing;
    if (confirmed[i]) candidates_[i].setObservations(calibration_.camera, std::move((*seen)[i]));
  }
  const auto count = std::count(confirmed.begin(), confirmed.end(), char{1});
  if (static_cast<double>(count) >= kKnownSurface * static_cast<double>(candidates_.size())) {
    std::vector<Candidate> kept;
    kept.reserve(candidates_.size());
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (confirmed[i]) kept.push_back(std::move(candidates_[i]));
    }
    candidates_ = std::move(kept);
  }
  recover_.min_agreeing = std::min(recover_.min_agreeing, 1.0 - kMayBeHidden);
  return {};
}

Result<void> Finisher::densifyCloud(const Task& task) {
  const PointEstimator estimator = estimatorAtPoses(sigma_rad_);
  const std::vector<GreyView> views = viewsAtPoses();
  const SilhouetteRecord silhouettes = silhouettes_.turned(corrections_rad_);
  const DenseScene scene{calibration_.camera, turn_.kept,   views,
                         estimator,           least_sigma_, silhouettes};
  return densify(scene, options_, result_.cloud, candidates_, task);
}

void Finisher::gatherSightings() {
  std::vector<double> distances_px;
  double squares = 0.0;
  double ray_distances_mm = 0.0;
  result_.sightings.assign(candidates_.size(), {});
  std::size_t all = 0;
  for (const Point& point : result_.cloud.points) all += point.views.size();
  distances_px.reserve(all);
  for (std::size_t index = 0; index < candidates_.size(); ++index) {
    Candidate& candidate = candidates_[index];
    const Eigen::Vector3d& position = candidate.estimated->position_in_table;
    result_.sightings[index].reserve(result_.cloud.points[index].views.size());
    for (std::size_t i = 0; i < candidate.sightings.size(); ++i) {
      if (candidate.estimated->agrees[i] == 0) continue;
      const Observation& seen = candidate.observations[i];
      result_.sightings[index].push_back(seen);
      const Rigid3& pose = poses_[static_cast<std::size_t>(seen.view)];
      const auto pixel = calibration_.camera.project(pose * position);
      if (!pixel) continue;
      distances_px.push_back((*pixel - seen.pixel).norm());
      squares += distances_px.back() * distances_px.back();
      ray_distances_mm +=
          distanceToLine(rayThrough(pose, candidate.sightings[i].normalized), position);
    }
    candidate = {};  // makes room as the result grows
  }
  candidates_.clear();
  result_.observations = distances_px.size();
  if (distances_px.empty()) return;
  const auto count = static_cast<double>(distances_px.size());
  result_.ray_distance_mm = ray_distances_mm / count;
  result_.rms_px = std::sqrt(squares / count);
  result_.median_px = median(std::move(distances_px));
}

// What all sightings of a point share does not show in their residuals: a surface under the patch
// that is no quadric, light that moves over it. It differs from point to point, so that neighbours
// disagree by it, along the normal; but not such that share most of their patch.
void Finisher::widenByScatter() {
  if (result_.cloud.points.empty()) return;
  const double patch_mm =
      options_.track.window_px * mmAPixel(calibration_.camera, poses_.front(), result_.cloud);
  const std::vector<double> scatter_mm =
      pointScatter(result_.cloud, {kErrAlike * patch_mm, kFewPatches * patch_mm});
  for (std::size_t i = 0; i < scatter_mm.size(); ++i) {
    Point& point = result_.cloud.points[i];
    point.covariance += scatter_mm[i] * scatter_mm[i] * point.normal * point.normal.transpose();
  }
}

Reconstruction Finisher::take() {
  widenByScatter();
  gatherSightings();
  if (turn_.closure) result_.turn_gap = turn_.closure->gap;
  return std::move(result_);
}

}  // namespace

Result<Reconstruction> finalCloud(const TrackedTurn& turn, const Calibration& calibration,
                                  const SilhouetteRecord& silhouettes,
                                  const ReconstructOptions& options, const Task& task) {
  Finisher finisher(turn, calibration, silhouettes, options);
  const double start_s = steadySeconds();
  if (auto done = finisher.estimate(task.part(0.0, 0.3)); !done) return done.error();
  if (auto done = finisher.gather(task.part(0.3, 0.4)); !done) return done.error();
  double reobserve_s = 0.0;
  for (int round = 0; round < kMostRounds; ++round) {
    const double from = 0.4 + 0.2 * round / kMostRounds;
    const double each = 0.2 / kMostRounds;
    const double looked_s = steadySeconds();
    if (auto done = finisher.reobserveAll(task.part(from, from + 0.5 * each)); !done) {
      return done.error();
    }
    reobserve_s += steadySeconds() - looked_s;
    const std::vector<double> before_rad = finisher.correctionsRad();
    if (auto done = finisher.estimate(task.part(from + 0.5 * each, from + 0.9 * each)); !done) {
      return done.error();
    }
    if (auto done = finisher.gather(task.part(from + 0.9 * each, from + each)); !done) {
      return done.error();
    }
    if (furthest(before_rad, finisher.correctionsRad()) < kSettled_rad) break;
  }
  const double dense_s = steadySeconds();
  if (auto done = finisher.densifyCloud(task.part(0.6, 0.99)); !done) return done.error();
  const double grown_s = steadySeconds() - dense_s;
  if (auto done = finisher.judge(task.part(0.99, 1.0)); !done) return done.error();
  Reconstruction result = finisher.take();
  result.seconds["reobserve"] = reobserve_s;
  result.seconds["recover"] = steadySeconds() - start_s - reobserve_s - grown_s;
  result.seconds["grow"] = grown_s;
  return result;
}

}  // namespace gyre
