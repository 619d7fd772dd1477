// From all tracks of a turn to the points that are kept, with the table's true angles.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/cloud_filter.h"
#include "core/pipeline/options.h"
#include "core/pipeline/reconstruction.h"
#include "core/scan/calibration.h"
#include "core/track/feature_tracker.h"
#include "core/track/kept_view.h"

namespace gyre {

// All that the views of a turn have left.
struct TrackedTurn {
  std::vector<const MeasuredTrack*> tracks;
  std::vector<Rigid3> cam_from_table;              // one a view, at the angle told
  std::span<const KeptView> kept;                  // one a view
  TurningReport turning;                           // what is known of the angles beforehand
  std::optional<FeatureTracker::Closure> closure;  // after a whole turn
};

// Estimates all points and angles from the tracks (estimateTurn) and judges them; looks for the
// points that are kept in every view that can show them (reobserve) and estimates all once more
// from what was seen there, again while that moves the angles; and grows points between them
// (densify). Gives cloud, residuals, angles and the gap; what else a reconstruction holds is the
// caller's. kCancelled when stopped. The same result for any number of threads.
Result<Reconstruction> finalCloud(const TrackedTurn& turn, const Calibration& calibration,
                                  const SilhouetteRecord& silhouettes,
                                  const ReconstructOptions& options, const Task& task);

}  // namespace gyre
