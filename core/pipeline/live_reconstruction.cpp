// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/live_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"
#include "core/mesh/point_normals.h"
#include "core/pipeline/cloud_filter.h"
#include "core/pipeline/drift_words.h"
#include "core/pipeline/platter_ring.h"
#include "core/pipeline/solved_turning.h"
#include "core/recover/turn_estimator.h"
#include "core/scan/picture_size.h"
#include "core/track/drift_monitor.h"
#include "core/track/empty_table_mask.h"
#include "core/track/feature_tracker.h"
#include "core/track/moving_mask.h"

namespace gyre {
namespace {

// Until a live point has this much parallax it is not shown: it would jump about.
constexpr double kShownParallax_rad = 0.08;

Result<void> checkSize(const CameraModel& camera, const Frame& frame) {
  const cv::Mat& image = frame.image_bgr;
  return checkCalibratedSize({image.cols, image.rows}, camera,
                             "The picture " + frame.name + " has");
}

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

Point pointOf(const MeasuredTrack& track, const EstimatedPoint& estimated) {
  Point point;
  point.position = estimated.position_in_table;
  point.covariance = estimated.covariance;
  point.rgb = middleColour(track.colours);
  for (std::size_t i = 0; i < track.sightings.size(); ++i) {
    if (estimated.agrees[i] != 0) {
      point.views.push_back(static_cast<std::uint32_t>(track.sightings[i].view));
    }
  }
  return point;
}

// For each point the mean direction to the cameras that saw it, in the table frame.
std::vector<Eigen::Vector3d> directionsToCameras(
    const PointCloud& cloud, const std::vector<Rigid3>& cam_from_table_of_view) {
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(cam_from_table_of_view.size());
  for (const Rigid3& pose : cam_from_table_of_view) centres.push_back(pose.inverse().translation);
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t view : point.views) {
      sum += (centres[view] - point.position).normalized();
    }
    directions.push_back(sum);
  }
  return directions;
}

}  // namespace

class LiveReconstruction::Impl {
 public:
  Impl(const CalibrationRecord& record, FramePtr empty_table, const ReconstructOptions& options,
       FeatureTracker tracker)
      : calibration_(record.calibration),
        options_(options),
        tracker_(std::move(tracker)),
        silhouettes_(record.calibration),
        ring_(PlatterRing::of(record)),
        empty_table_(std::move(empty_table)) {}

  Result<TrackedFrame> addFrame(const FramePtr& told, const cv::Mat& object_mask);
  PointCloudPtr cloudSoFar() const;
  Result<Reconstruction> finish(const Task& task) const;

 private:
  struct Candidate {
    const MeasuredTrack* track = nullptr;
    std::optional<EstimatedPoint> estimated;
  };

  FramePtr atSeenAngle(const FramePtr& frame);
  ViewDrift latestDrift() const;
  bool coversFullTurn() const;
  bool plausible(const EstimatedPoint& estimated) const;
  TurningReport turningSoFar() const;
  Result<TurnEstimate> estimateAll(const std::vector<const MeasuredTrack*>& tracks,
                                   const std::optional<FeatureTracker::Closure>& closure,
                                   const TurningReport& turning, const Task& task) const;
  void measureResiduals(const std::vector<Candidate>& accepted, const std::vector<Rigid3>& poses,
                        Reconstruction& result) const;

  Calibration calibration_;
  ReconstructOptions options_;
  FeatureTracker tracker_;
  SilhouetteRecord silhouettes_;
  std::optional<PlatterRing> ring_;
  FramePtr empty_table_;  // null when there is none
  std::optional<EmptyTableMask> empty_table_mask_;
  MovingMask moving_mask_;
  DriftMonitor drift_;
  std::vector<TurnedView> views_;  // at the angles that were tracked with
  double ring_seconds_ = 0.0;
  double mask_seconds_ = 0.0;
  double track_seconds_ = 0.0;
  double drift_seconds_ = 0.0;
};

// The empty table's angle can be told by the ring once a frame has shown it.
FramePtr LiveReconstruction::Impl::atSeenAngle(const FramePtr& frame) {
  FramePtr seen = ring_ ? ring_->follow(frame) : frame;
  if (empty_table_ && !empty_table_mask_) {
    empty_table_mask_.emplace(calibration_,
                              ring_ ? ring_->withSeenAngle(empty_table_) : empty_table_);
  }
  return seen;
}

// A platter that moved is told even where the background stood still.
ViewDrift LiveReconstruction::Impl::latestDrift() const {
  const ViewDrift still = drift_.latest();
  return ring_ && !still.moved && ring_->drift().back().moved ? ring_->drift().back() : still;
}

Result<TrackedFrame> LiveReconstruction::Impl::addFrame(const FramePtr& told,
                                                        const cv::Mat& object_mask) {
  if (auto fits = checkSize(calibration_.camera, *told); !fits) return fits.error();
  const double looked_s = steadySeconds();
  const FramePtr frame = atSeenAngle(told);
  const double start_s = steadySeconds();
  ring_seconds_ += start_s - looked_s;
  const cv::Mat mask = !object_mask.empty() ? cv::Mat(object_mask > 127)
                       : empty_table_mask_  ? empty_table_mask_->maskOf(*frame)
                                            : moving_mask_.addFrame(*frame);
  silhouettes_.addView(mask, frame->table_angle_rad);
  views_.push_back({frame->view, frame->name, false, frame->table_angle_rad, frame->table_angle_rad,
                    0.0, false});
  const double masked_s = steadySeconds();
  TrackedFrame tracked = tracker_.addFrame(frame, mask);
  const double tracked_s = steadySeconds();
  drift_.addFrame(*frame);
  tracked.drift = latestDrift();
  mask_seconds_ += masked_s - start_s;
  track_seconds_ += tracked_s - masked_s;
  drift_seconds_ += steadySeconds() - tracked_s;
  return tracked;
}

bool LiveReconstruction::Impl::coversFullTurn() const {
  if (views_.size() < 3) return false;
  const double turned_rad = std::abs(views_.back().angle_rad - views_.front().angle_rad);
  const double last_step_rad =
      std::abs(views_.back().angle_rad - views_[views_.size() - 2].angle_rad);
  return std::abs(kTurn_rad - turned_rad) < 1.5 * last_step_rad;
}

bool LiveReconstruction::Impl::plausible(const EstimatedPoint& estimated) const {
  // The platter's own texture scatters about its height: a point must be clearly above it.
  const double z_sigma = std::sqrt(estimated.covariance(2, 2));
  return estimated.agreeing >= options_.recover.min_views &&
         estimated.chi2_per_freedom <= options_.cloud.max_chi2 &&
         estimated.position_in_table.z() - 2.0 * z_sigma >= options_.track.min_height_mm;
}

PointCloudPtr LiveReconstruction::Impl::cloudSoFar() const {
  PointCloud cloud;
  for (const MeasuredTrack* track : tracker_.tracks()) {
    const EstimatedPoint& estimated = *track->point;
    if (estimated.parallax_rad < kShownParallax_rad || !plausible(estimated)) continue;
    cloud.points.push_back(pointOf(*track, estimated));
  }
  const auto keep = judgePoints(cloud, silhouettes_, options_.cloud, Scrutiny::kGlance);
  auto kept = std::make_shared<PointCloud>();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) kept->points.push_back(std::move(cloud.points[i]));
  }
  return kept;
}

// With a ring, what it told; without, the views where they were told to be.
TurningReport LiveReconstruction::Impl::turningSoFar() const {
  if (ring_) return ring_->turning();
  TurningReport turning;
  turning.views = views_;
  return turning;
}

Result<TurnEstimate> LiveReconstruction::Impl::estimateAll(
    const std::vector<const MeasuredTrack*>& tracks,
    const std::optional<FeatureTracker::Closure>& closure, const TurningReport& turning,
    const Task& task) const {
  // Tracks of the last view that the first one shows again: they hold the ends of the turn
  // together.
  std::map<std::uint32_t, std::vector<Sighting>> joined;
  if (closure) {
    for (const auto& [track_id, sighting] : closure->tracks) joined[track_id] = {sighting};
  }
  std::vector<TrackSightings> sightings;
  sightings.reserve(tracks.size());
  for (const MeasuredTrack* track : tracks) {
    const auto found = joined.find(track->track.id);
    if (found == joined.end()) {
      sightings.push_back({track->sightings, track->track.id});
      continue;
    }
    std::vector<Sighting>& all = found->second;
    all.insert(all.end(), track->sightings.begin(), track->sightings.end());
    sightings.push_back({all, track->track.id});
  }
  const AngleBeliefs beliefs = beliefsBeforeSolving(turning.views, options_.recover);
  auto turn = estimateTurn(sightings, tracker_.estimator().poses(), beliefs.knowledge(),
                           options_.recover, task);
  if (!turn) return turn;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    auto& point = turn->points[i];
    if (point && point->agrees.size() > tracks[i]->sightings.size()) {
      point->agrees.erase(point->agrees.begin());  // back to one a sighting of the track
    }
  }
  return turn;
}

void LiveReconstruction::Impl::measureResiduals(const std::vector<Candidate>& accepted,
                                                const std::vector<Rigid3>& poses,
                                                Reconstruction& result) const {
  std::vector<double> distances_px;
  double squares = 0.0;
  for (const Candidate& candidate : accepted) {
    const MeasuredTrack& track = *candidate.track;
    for (std::size_t i = 0; i < track.sightings.size(); ++i) {
      if (candidate.estimated->agrees[i] == 0) continue;
      const Observation& seen = track.track.observations[i];
      const Rigid3& pose = poses[static_cast<std::size_t>(seen.view)];
      const auto pixel = calibration_.camera.project(pose * candidate.estimated->position_in_table);
      if (!pixel) continue;
      distances_px.push_back((*pixel - seen.pixel).norm());
      squares += distances_px.back() * distances_px.back();
    }
  }
  result.observations = distances_px.size();
  if (distances_px.empty()) return;
  result.rms_px = std::sqrt(squares / static_cast<double>(distances_px.size()));
  result.median_px = median(std::move(distances_px));
}

Result<Reconstruction> LiveReconstruction::Impl::finish(const Task& task) const {
  const double start_s = steadySeconds();
  const std::vector<const MeasuredTrack*> tracks = tracker_.tracks();
  const TurningReport turning = turningSoFar();
  const auto closure = coversFullTurn() ? tracker_.closure() : std::nullopt;
  auto turn = estimateAll(tracks, closure, turning, task.part(0.0, 0.6));
  if (!turn) return turn.error();
  std::vector<Rigid3> poses = tracker_.estimator().poses();
  for (std::size_t view = 0; view < poses.size(); ++view) {
    poses[view] = camFromTable(poses[view], turn->corrections_rad[view]);
  }
  task.report(0.6, "Weighing points");

  Reconstruction result;
  result.turning = afterSolving(turning, *turn);
  std::vector<Candidate> plausibles;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!turn->points[i] || !plausible(*turn->points[i])) continue;
    result.cloud.points.push_back(pointOf(*tracks[i], *turn->points[i]));
    plausibles.push_back({tracks[i], std::move(turn->points[i])});
  }
  const auto keep = judgePoints(result.cloud, silhouettes_.turned(turn->corrections_rad),
                                options_.cloud, Scrutiny::kFull);
  if (task.stopRequested()) return cancelled();
  std::vector<Candidate> accepted;
  PointCloud kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    kept.points.push_back(std::move(result.cloud.points[i]));
    accepted.push_back(std::move(plausibles[i]));
  }
  result.cloud = std::move(kept);
  const auto towards_camera = directionsToCameras(result.cloud, poses);
  if (auto set = setPointNormals(result.cloud, towards_camera, {}, task); !set) return set.error();
  measureResiduals(accepted, poses, result);
  if (closure) result.turn_gap = closure->gap;
  result.drift = drift_.report();
  if (ring_) addPlatter(result.drift, ring_->drift());
  result.seconds = {{"mask", mask_seconds_},
                    {"track", track_seconds_},
                    {"drift", drift_seconds_},
                    {"recover", steadySeconds() - start_s}};
  if (ring_) result.seconds["ring"] = ring_seconds_;
  task.report(1.0, "Points ready");
  return result;
}

Result<LiveReconstruction> LiveReconstruction::create(const CalibrationRecord& record,
                                                      const FramePtr& empty_table,
                                                      const ReconstructOptions& options) {
  if (auto valid = options.validate(); !valid) return valid.error();
  if (empty_table) {
    if (auto fits = checkSize(record.calibration.camera, *empty_table); !fits) return fits.error();
  }
  auto tracker = FeatureTracker::create(record.calibration, options.track, options.recover);
  if (!tracker) return tracker.error();
  return LiveReconstruction(
      std::make_unique<Impl>(record, empty_table, options, std::move(*tracker)));
}

LiveReconstruction::LiveReconstruction(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveReconstruction::LiveReconstruction(LiveReconstruction&&) noexcept = default;
LiveReconstruction& LiveReconstruction::operator=(LiveReconstruction&&) noexcept = default;
LiveReconstruction::~LiveReconstruction() = default;

Result<TrackedFrame> LiveReconstruction::addFrame(const FramePtr& frame,
                                                  const cv::Mat& object_mask) {
  return impl_->addFrame(frame, object_mask);
}
PointCloudPtr LiveReconstruction::cloudSoFar() const { return impl_->cloudSoFar(); }
Result<Reconstruction> LiveReconstruction::finish(const Task& task) const {
  return impl_->finish(task);
}

}  // namespace gyre
