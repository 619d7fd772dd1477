// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/live_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/mesh/point_normals.h"
#include "core/pipeline/cloud_filter.h"
#include "core/pipeline/drift_words.h"
#include "core/pipeline/platter_ring.h"
#include "core/scan/picture_size.h"
#include "core/track/drift_monitor.h"
#include "core/track/empty_table_mask.h"
#include "core/track/feature_tracker.h"
#include "core/track/moving_mask.h"

namespace gyre {
namespace {

// Until a live point has this much parallax it is not shown: it would jump about.
constexpr double kShownParallax_rad = 0.08;
constexpr std::size_t kGrain = 64;

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
  void measureResiduals(const std::vector<Candidate>& accepted, Reconstruction& result) const;

  Calibration calibration_;
  ReconstructOptions options_;
  FeatureTracker tracker_;
  SilhouetteRecord silhouettes_;
  std::optional<PlatterRing> ring_;
  FramePtr empty_table_;  // null when there is none
  std::optional<EmptyTableMask> empty_table_mask_;
  MovingMask moving_mask_;
  DriftMonitor drift_;
  std::vector<double> table_angles_rad_;
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
  table_angles_rad_.push_back(frame->table_angle_rad);
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
  if (table_angles_rad_.size() < 3) return false;
  const double turned_rad = std::abs(table_angles_rad_.back() - table_angles_rad_.front());
  const double last_step_rad =
      std::abs(table_angles_rad_.back() - table_angles_rad_[table_angles_rad_.size() - 2]);
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

void LiveReconstruction::Impl::measureResiduals(const std::vector<Candidate>& accepted,
                                                Reconstruction& result) const {
  std::vector<double> distances_px;
  double squares = 0.0;
  for (const Candidate& candidate : accepted) {
    const MeasuredTrack& track = *candidate.track;
    for (std::size_t i = 0; i < track.sightings.size(); ++i) {
      if (candidate.estimated->agrees[i] == 0) continue;
      const Observation& seen = track.track.observations[i];
      const Rigid3& pose = tracker_.estimator().poses()[static_cast<std::size_t>(seen.view)];
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
  std::vector<Candidate> candidates;
  for (const MeasuredTrack* track : tracker_.tracks()) candidates.push_back({track, {}});
  parallelFor(candidates.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      const MeasuredTrack& track = *candidates[i].track;
      candidates[i].estimated = tracker_.estimator().estimate(track.sightings, track.track.id);
    }
  });
  task.report(0.6, "Weighing points");
  if (task.stopRequested()) return cancelled();

  Reconstruction result;
  std::vector<Candidate> plausibles;
  for (Candidate& candidate : candidates) {
    if (!candidate.estimated || !plausible(*candidate.estimated)) continue;
    result.cloud.points.push_back(pointOf(*candidate.track, *candidate.estimated));
    plausibles.push_back(std::move(candidate));
  }
  const auto keep = judgePoints(result.cloud, silhouettes_, options_.cloud, Scrutiny::kFull);
  if (task.stopRequested()) return cancelled();
  std::vector<Candidate> accepted;
  PointCloud kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    kept.points.push_back(std::move(result.cloud.points[i]));
    accepted.push_back(std::move(plausibles[i]));
  }
  result.cloud = std::move(kept);
  const auto towards_camera = directionsToCameras(result.cloud, tracker_.estimator().poses());
  if (auto set = setPointNormals(result.cloud, towards_camera, {}, task); !set) return set.error();
  measureResiduals(accepted, result);
  if (coversFullTurn()) result.turn_gap = tracker_.turnGap();
  result.drift = drift_.report();
  if (ring_) {
    result.turning = ring_->turning();
    addPlatter(result.drift, ring_->drift());
  }
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
