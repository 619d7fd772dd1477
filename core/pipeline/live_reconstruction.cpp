// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/live_reconstruction.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/pipeline/candidate.h"
#include "core/pipeline/cloud_filter.h"
#include "core/pipeline/drift_words.h"
#include "core/pipeline/final_cloud.h"
#include "core/pipeline/platter_ring.h"
#include "core/scan/picture_size.h"
#include "core/track/drift_monitor.h"
#include "core/track/empty_table_mask.h"
#include "core/track/feature_tracker.h"
#include "core/track/grey_pyramid.h"
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
  FramePtr atSeenAngle(const FramePtr& frame);
  ViewDrift latestDrift() const;
  bool coversFullTurn() const;
  TurningReport turningSoFar() const;

  Calibration calibration_;
  ReconstructOptions options_;
  FeatureTracker tracker_;
  SilhouetteRecord silhouettes_;
  std::optional<PlatterRing> ring_;
  FramePtr empty_table_;  // null when there is none
  std::optional<EmptyTableMask> empty_table_mask_;
  MovingMask moving_mask_;
  DriftMonitor drift_;
  std::vector<KeptView> kept_;
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
  mask_seconds_ += masked_s - start_s;
  // Three things that do not need each other; the first takes longest.
  TrackedFrame tracked;
  parallelFor(3, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t job = begin; job < end; ++job) {
      const double begun_s = steadySeconds();
      if (job == 0) {
        tracked = tracker_.addFrame(frame, mask);
        track_seconds_ += steadySeconds() - begun_s;
      } else if (job == 1) {
        kept_.push_back(keepView(frame->image_bgr, mask));
      } else {
        drift_.addFrame(*frame);
        drift_seconds_ += steadySeconds() - begun_s;
      }
    }
  });
  tracked.drift = latestDrift();
  return tracked;
}

bool LiveReconstruction::Impl::coversFullTurn() const {
  if (views_.size() < 3) return false;
  const double turned_rad = std::abs(views_.back().angle_rad - views_.front().angle_rad);
  const double last_step_rad =
      std::abs(views_.back().angle_rad - views_[views_.size() - 2].angle_rad);
  return std::abs(kTurn_rad - turned_rad) < 1.5 * last_step_rad;
}

PointCloudPtr LiveReconstruction::Impl::cloudSoFar() const {
  PointCloud cloud;
  for (const MeasuredTrack* track : tracker_.tracks()) {
    const EstimatedPoint& estimated = *track->point;
    if (estimated.parallax_rad < kShownParallax_rad || !plausible(estimated, options_)) continue;
    cloud.points.push_back(pointOf(middleColour(track->colours), track->sightings, estimated));
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

Result<Reconstruction> LiveReconstruction::Impl::finish(const Task& task) const {
  const TrackedTurn turn{tracker_.tracks(), tracker_.estimator().poses(), kept_, turningSoFar(),
                         coversFullTurn() ? tracker_.closure() : std::nullopt};
  auto result = finalCloud(turn, calibration_, silhouettes_, options_, task);
  if (!result) return result.error();
  result->silhouettes = silhouettes_.silhouettes();
  result->drift = drift_.report();
  if (ring_) addPlatter(result->drift, ring_->drift());
  result->seconds["mask"] = mask_seconds_;
  result->seconds["track"] = track_seconds_;
  result->seconds["drift"] = drift_seconds_;
  if (ring_) result->seconds["ring"] = ring_seconds_;
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
