// Follows features of the turning object from view to view and recovers their points as it goes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/recover/point_estimator.h"
#include "core/scan/calibration.h"
#include "core/scan/point_cloud.h"
#include "core/scan/track.h"
#include "core/scan/tracked_frame.h"
#include "core/track/options.h"
#include "core/track/turn_gap.h"

namespace gyre {

// A track with what its sightings say of the point.
struct MeasuredTrack {
  Track track;
  std::vector<Sighting> sightings;  // one an observation, undistorted
  std::vector<Rgb> colours;         // one an observation
  std::optional<EstimatedPoint> point;
};

// Views must come in the order of their angles, either way round. Track and sighting views count
// the frames given, from 0. Results do not depend on the number of threads. One thread at a time.
//
// The paper's KLT (Leow et al. 2000, section 3.1) with its boundary rule, made for known turning:
// where a feature must appear is computed, not searched for, as soon as two views have seen it.
class FeatureTracker {
 public:
  // Fails when an option is out of range or the calibration has no cam_from_table.
  static Result<FeatureTracker> create(const Calibration& calibration, const TrackOptions& options,
                                       const RecoverOptions& recover_options);

  FeatureTracker(FeatureTracker&&) noexcept;
  FeatureTracker& operator=(FeatureTracker&&) noexcept;
  ~FeatureTracker();

  // Follows all features into the frame, ends the tracks that do not pass the gates, and begins new
  // ones where the object shows none. object_mask: 8 bit, the frame's size, non-zero on the object.
  TrackedFrame addFrame(const FramePtr& frame, const cv::Mat& object_mask);

  // Every track with at least the least number of views, ended ones first, in a fixed order.
  // Pointers hold until the next addFrame().
  std::vector<const MeasuredTrack*> tracks() const;

  // A track of the last view, and where the first view shows its point.
  struct ReturnedTrack {
    std::uint32_t track_id = 0;
    Sighting sighting;
  };
  struct Closure {
    TurnGap gap;
    std::vector<ReturnedTrack> tracks;
  };

  // How far the last view misses the first, told by features seen only late in the turn. Meaningful
  // after a whole turn; nothing when too few features reach from the last view to the first.
  std::optional<Closure> closure() const;

  const PointEstimator& estimator() const;  // with the poses of all frames so far

 private:
  class Impl;
  explicit FeatureTracker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyre
