// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/feature_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/ray_intersection.h"
#include "core/track/correlation.h"
#include "core/track/epipolar_search.h"
#include "core/track/feature_detector.h"
#include "core/track/grey_pyramid.h"
#include "core/track/klt_step.h"
#include "core/track/reference_patch.h"
#include "core/track/search_volume.h"
#include "core/track/track_gates.h"

namespace gyre {
namespace {

constexpr std::size_t kTailViews = 12;
// What LK leaves of a feature's position however strong its texture: interpolation, foreshortening.
constexpr double kTrackingFloor_px = 0.05;
// A reference patch serves until the table has turned this far: beyond, it looks too different.
constexpr double kReferenceTurn_rad = 0.26;
constexpr std::size_t kGrain = 32;
// Correlation along the curve that is worth refining.
constexpr float kLeastSearchCorrelation = 0.6F;

Rgb colourAt(const cv::Mat& image_bgr, const Eigen::Vector2d& pixel) {
  const int column = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, image_bgr.cols - 1);
  const int row = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, image_bgr.rows - 1);
  const auto& bgr = image_bgr.at<cv::Vec3b>(row, column);
  return {bgr[2], bgr[1], bgr[0]};
}

}  // namespace

class FeatureTracker::Impl {
 public:
  Impl(const Calibration& calibration, const TrackOptions& options, PointEstimator estimator)
      : calibration_(calibration),
        options_(options),
        estimator_(std::move(estimator)),
        volume_(visibleVolume(calibration.camera, *calibration.cam_from_table)),
        search_(calibration.camera, volume_) {}

  TrackedFrame addFrame(const FramePtr& frame, const cv::Mat& object_mask);
  std::vector<const MeasuredTrack*> tracks() const;
  const PointEstimator& estimator() const { return estimator_; }
  std::optional<Closure> closure() const;

 private:
  // A track that goes on, and the patch that holds it in its place.
  struct ActiveTrack {
    MeasuredTrack measured;
    std::shared_ptr<const ReferencePatch> reference;  // null when its texture fixes no shape
    double begun_angle_rad = 0.0;                     // of the table
    double reference_angle_rad = 0.0;                 // of the table
    PatchPlace place;                                 // in the view before

    const Observation& last() const { return measured.track.observations.back(); }
  };

  // What following one active track into the new view came to.
  struct Step {
    std::optional<Eigen::Vector2d> predicted;
    std::optional<PatchPlace> found;
    std::optional<EstimatedPoint> point;
  };

  const Rigid3& pose(std::int32_t view) const {
    return estimator_.poses()[static_cast<std::size_t>(view)];
  }
  Ray rayOf(const Sighting& sighting) const;
  Sighting sightingAt(std::int32_t view, const Eigen::Vector2d& pixel, double sigma_px) const;

  void predict(const GreyPyramid& now, std::int32_t view, std::vector<Step>& steps) const;
  void follow(const GreyPyramid& now, const cv::Mat& allowed, std::vector<Step>& steps) const;
  std::optional<PatchPlace> held(const ActiveTrack& active, const Eigen::Vector2d& pixel,
                                 const GreyPyramid& now, const cv::Mat& allowed) const;
  void measure(std::int32_t view, std::vector<Step>& steps) const;
  std::optional<EstimatedPoint> updatedPoint(const MeasuredTrack& active,
                                             const Sighting& latest) const;
  bool fits(const MeasuredTrack& active, const Sighting& latest, const EstimatedPoint& point) const;
  void advance(const FramePtr& frame, const GreyPyramid& now, std::int32_t view,
               std::vector<Step>& steps);
  void anchor(ActiveTrack& active, const cv::Mat& grey, double table_angle_rad) const;
  void end(MeasuredTrack&& track);
  void detect(const FramePtr& frame, const GreyPyramid& now, const cv::Mat& allowed,
              std::int32_t view);
  TrackedFrame marks(const FramePtr& frame) const;

  Calibration calibration_;
  TrackOptions options_;
  PointEstimator estimator_;
  SearchVolume volume_;
  EpipolarSearch search_;
  GreyPyramid first_;
  GreyPyramid before_;
  std::vector<ActiveTrack> active_;
  std::vector<MeasuredTrack> ended_;
  std::uint32_t next_id_ = 0;
};

Ray FeatureTracker::Impl::rayOf(const Sighting& sighting) const {
  return rayThrough(pose(sighting.view), sighting.normalized);
}

Sighting FeatureTracker::Impl::sightingAt(std::int32_t view, const Eigen::Vector2d& pixel,
                                          double sigma_px) const {
  const CameraModel& camera = calibration_.camera;
  return {view, camera.normalizedFromPixel(pixel), sigma_px / std::sqrt(camera.fx * camera.fy)};
}

void FeatureTracker::Impl::predict(const GreyPyramid& now, std::int32_t view,
                                   std::vector<Step>& steps) const {
  parallelFor(active_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const MeasuredTrack& active = active_[i].measured;
      const Observation& last = active_[i].last();
      if (active.point) {
        steps[i].predicted =
            calibration_.camera.project(pose(view) * active.point->position_in_table);
        continue;
      }
      const auto match =
          search_.find(before_.grey, pose(last.view), last.pixel, now.grey, pose(view));
      if (match && match->correlation >= kLeastSearchCorrelation) steps[i].predicted = match->pixel;
    }
  });
}

void FeatureTracker::Impl::follow(const GreyPyramid& now, const cv::Mat& allowed,
                                  std::vector<Step>& steps) const {
  std::vector<KltMove> moves;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (!steps[i].predicted || !calibration_.camera.contains(*steps[i].predicted)) continue;
    moves.push_back({active_[i].last().pixel.cast<float>(), steps[i].predicted->cast<float>()});
    owner.push_back(i);
  }
  const auto outcomes = kltStep(before_, now, moves, options_.window_px);
  parallelFor(outcomes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const KltOutcome& outcome = outcomes[k];
      if (!outcome.found || outcome.round_trip_px > options_.max_round_trip_px) continue;
      steps[owner[k]].found = held(active_[owner[k]], outcome.to.cast<double>(), now, allowed);
    }
  });
}

std::optional<PatchPlace> FeatureTracker::Impl::held(const ActiveTrack& active,
                                                     const Eigen::Vector2d& pixel,
                                                     const GreyPyramid& now,
                                                     const cv::Mat& allowed) const {
  PatchPlace place{pixel, active.place.shape};
  if (active.reference) {
    const auto alignment = active.reference->align(now.grey, place);
    if (!alignment || alignment->correlation < options_.min_correlation) return std::nullopt;
    place = alignment->place;
  } else {
    const auto was = samplePatch(before_.grey, active.last().pixel);
    const auto is = samplePatch(now.grey, pixel);
    if (!was || !is || correlate(*was, *is) < options_.min_correlation) return std::nullopt;
  }
  if (!calibration_.camera.contains(place.pixel, 1.0)) return std::nullopt;
  const int column = static_cast<int>(std::lround(place.pixel.x()));
  const int row = static_cast<int>(std::lround(place.pixel.y()));
  if (allowed.at<std::uint8_t>(row, column) == 0) return std::nullopt;
  return place;
}

std::optional<EstimatedPoint> FeatureTracker::Impl::updatedPoint(const MeasuredTrack& active,
                                                                 const Sighting& latest) const {
  std::vector<Sighting> sightings = active.sightings;
  sightings.push_back(latest);
  if (active.point) return estimator_.refine(sightings, active.point->position_in_table);
  constexpr double kLeastParallax_rad = 0.003;
  const auto start = intersectTwoRays(rayOf(sightings.front()), rayOf(latest), kLeastParallax_rad);
  if (!start) return std::nullopt;
  return estimator_.refine(sightings, *start);
}

void FeatureTracker::Impl::measure(std::int32_t view, std::vector<Step>& steps) const {
  parallelFor(active_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!steps[i].found) continue;
      const MeasuredTrack& active = active_[i].measured;
      const Sighting latest = sightingAt(view, steps[i].found->pixel, active_[i].last().sigma_px);
      steps[i].point = updatedPoint(active, latest);
      if (!steps[i].point ||
          !fitsTurning({calibration_.camera, pose(view), volume_}, active.sightings.size(), latest,
                       *steps[i].point, options_)) {
        steps[i].found.reset();
      }
    }
  });
}

void FeatureTracker::Impl::end(MeasuredTrack&& track) {
  track.point = estimator_.estimate(track.sightings, track.track.id);
  if (track.point) ended_.push_back(std::move(track));
}

void FeatureTracker::Impl::advance(const FramePtr& frame, const GreyPyramid& now, std::int32_t view,
                                   std::vector<Step>& steps) {
  std::vector<ActiveTrack> going_on;
  going_on.reserve(active_.size());
  for (std::size_t i = 0; i < active_.size(); ++i) {
    ActiveTrack& active = active_[i];
    if (!steps[i].found) {
      end(std::move(active.measured));
      continue;
    }
    active.place = *steps[i].found;
    const double sigma_px = active.last().sigma_px;
    active.measured.track.observations.push_back({view, active.place.pixel, sigma_px});
    active.measured.sightings.push_back(sightingAt(view, active.place.pixel, sigma_px));
    active.measured.colours.push_back(colourAt(frame->image_bgr, active.place.pixel));
    active.measured.point = std::move(steps[i].point);
    const double turned_rad = frame->table_angle_rad - active.begun_angle_rad;
    if (!standsStill(active.measured.track, turned_rad)) going_on.push_back(std::move(active));
  }
  active_ = std::move(going_on);
  parallelFor(active_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double turned_rad = frame->table_angle_rad - active_[i].reference_angle_rad;
      if (std::abs(turned_rad) > kReferenceTurn_rad) {
        anchor(active_[i], now.grey, frame->table_angle_rad);
      }
    }
  });
}

void FeatureTracker::Impl::anchor(ActiveTrack& active, const cv::Mat& grey,
                                  double table_angle_rad) const {
  const Eigen::Vector2d pixel = active.last().pixel;
  active.reference.reset();
  if (auto patch = ReferencePatch::cut(grey, pixel, options_.window_px)) {
    active.reference = std::make_shared<const ReferencePatch>(std::move(*patch));
  }
  active.reference_angle_rad = table_angle_rad;
  active.place = {pixel, Eigen::Matrix2d::Identity()};
}

void FeatureTracker::Impl::detect(const FramePtr& frame, const GreyPyramid& now,
                                  const cv::Mat& allowed, std::int32_t view) {
  std::vector<Eigen::Vector2d> occupied;
  occupied.reserve(active_.size());
  for (const ActiveTrack& active : active_) occupied.push_back(active.last().pixel);
  const double noise_sigma = estimateNoiseSigma(now.grey, allowed);
  const auto features = detectFeatures(now.grey, noise_sigma, allowed, occupied, options_);
  const std::size_t first_new = active_.size();
  for (const Feature& feature : features) {
    MeasuredTrack fresh;
    fresh.track.id = next_id_++;
    const double sigma_px = std::hypot(feature.sigma_px, kTrackingFloor_px);
    fresh.track.observations.push_back({view, feature.pixel, sigma_px});
    fresh.sightings.push_back(sightingAt(view, feature.pixel, sigma_px));
    fresh.colours.push_back(colourAt(frame->image_bgr, feature.pixel));
    active_.push_back({std::move(fresh), nullptr, frame->table_angle_rad, 0.0, {}});
  }
  parallelFor(features.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      anchor(active_[first_new + i], now.grey, frame->table_angle_rad);
    }
  });
}

TrackedFrame FeatureTracker::Impl::marks(const FramePtr& frame) const {
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.marks.reserve(active_.size());
  for (const ActiveTrack& going_on : active_) {
    const MeasuredTrack& active = going_on.measured;
    FeatureMark mark;
    mark.track_id = active.track.id;
    const auto& observations = active.track.observations;
    mark.state = observations.size() == 1                   ? FeatureState::kNew
                 : active.point && observations.size() >= 5 ? FeatureState::kMeasured
                                                            : FeatureState::kTracked;
    const std::size_t first =
        observations.size() > kTailViews ? observations.size() - kTailViews : 0;
    for (std::size_t i = first; i < observations.size(); ++i) {
      mark.tail.push_back(observations[i].pixel.cast<float>());
    }
    tracked.marks.push_back(std::move(mark));
  }
  return tracked;
}

TrackedFrame FeatureTracker::Impl::addFrame(const FramePtr& frame, const cv::Mat& object_mask) {
  const auto view = static_cast<std::int32_t>(estimator_.poses().size());
  estimator_.addPose(camFromTable(*calibration_.cam_from_table, frame->table_angle_rad));
  GreyPyramid now = buildGreyPyramid(frame->image_bgr, options_.window_px);
  const cv::Mat allowed = allowedArea(object_mask, options_);
  std::vector<Step> steps(active_.size());
  if (!active_.empty()) {
    predict(now, view, steps);
    follow(now, allowed, steps);
    measure(view, steps);
  }
  advance(frame, now, view, steps);
  detect(frame, now, allowed, view);
  if (view == 0) first_ = now;
  before_ = std::move(now);
  return marks(frame);
}

std::vector<const MeasuredTrack*> FeatureTracker::Impl::tracks() const {
  std::vector<const MeasuredTrack*> all;
  all.reserve(ended_.size() + active_.size());
  for (const MeasuredTrack& track : ended_) all.push_back(&track);
  for (const ActiveTrack& active : active_) {
    if (active.measured.point) all.push_back(&active.measured);
  }
  return all;
}

std::optional<FeatureTracker::Closure> FeatureTracker::Impl::closure() const {
  const auto last_view = static_cast<std::int32_t>(estimator_.poses().size()) - 1;
  std::vector<LateFeature> late;
  std::vector<const MeasuredTrack*> tracks;
  for (const ActiveTrack& active : active_) {
    const MeasuredTrack& track = active.measured;
    const Observation& last = active.last();
    const bool begun_late = track.track.observations.front().view > last_view / 2;
    if (!track.point || !begun_late || last.view != last_view) continue;
    const auto settled = estimator_.estimate(track.sightings, track.track.id);
    if (!settled) continue;
    late.push_back({last.pixel, settled->position_in_table});
    tracks.push_back(&track);
  }
  auto gap = measureTurnGap({before_, first_, calibration_.camera, pose(0)}, late, options_);
  if (!gap) return std::nullopt;
  Closure closure;
  for (const ReturnedFeature& returned : gap->returned) {
    const MeasuredTrack& track = *tracks[returned.late];
    closure.tracks.push_back(
        {track.track.id, sightingAt(0, returned.pixel, track.track.observations.back().sigma_px)});
  }
  closure.gap = std::move(*gap);
  return closure;
}

Result<FeatureTracker> FeatureTracker::create(const Calibration& calibration,
                                              const TrackOptions& options,
                                              const RecoverOptions& recover_options) {
  if (!calibration.cam_from_table) {
    return Error{Error::Code::kInvalidInput, "The calibration does not say where the table is.",
                 "Calibrate with the target on the turning table."};
  }
  if (auto valid = options.validate(); !valid) return valid.error();
  auto estimator = PointEstimator::create(recover_options);
  if (!estimator) return estimator.error();
  return FeatureTracker(std::make_unique<Impl>(calibration, options, std::move(*estimator)));
}

FeatureTracker::FeatureTracker(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FeatureTracker::FeatureTracker(FeatureTracker&&) noexcept = default;
FeatureTracker& FeatureTracker::operator=(FeatureTracker&&) noexcept = default;
FeatureTracker::~FeatureTracker() = default;

TrackedFrame FeatureTracker::addFrame(const FramePtr& frame, const cv::Mat& object_mask) {
  return impl_->addFrame(frame, object_mask);
}
std::vector<const MeasuredTrack*> FeatureTracker::tracks() const { return impl_->tracks(); }
std::optional<FeatureTracker::Closure> FeatureTracker::closure() const { return impl_->closure(); }
const PointEstimator& FeatureTracker::estimator() const { return impl_->estimator(); }

}  // namespace gyre
