// All points of a turn and the table's angles, from all tracks.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/recover/angle_prior.h"
#include "core/recover/options.h"
#include "core/recover/point_estimator.h"

namespace gyre {

struct TrackSightings {
  std::span<const Sighting> sightings;
  std::uint64_t seed = 0;
  // Where the point is to some pixels, if that is known already. In the table frame, mm.
  std::optional<Eigen::Vector3d> start = std::nullopt;
};

// What is known of the table's angles beforehand.
struct AngleKnowledge {
  // How far they are off as a rule, beyond prior.start_rad: it loosens the sightings while points
  // are found one by one. [rad], one a view
  std::span<const double> expected_sigma_rad = {};
  // How far they may be found to be off.
  AnglePrior prior = {};
};

struct TurnEstimate {
  std::vector<std::optional<EstimatedPoint>> points;  // one a track; none for a bad track
  std::vector<double> corrections_rad;  // one a view: to be added to the table's angle
  std::vector<double> sigma_rad;        // of these, up to one turn of all views together
};

// The paper's estimate of every point by itself first; then, with the sightings that agree, the
// angles (solveJointAngles), robustly; then every point afresh at the better angles, with whatever
// agrees now; and the angles once more, plainly. Only a solver that knows errors can do so: with
// the paper's own solvers the angles stay as told.
//
// cam_from_table: one a view, at the angles told. When every prior is 0, points are estimated
// alone. Fails when an option is out of its range, and with kCancelled. The same result for any
// number of threads.
Result<TurnEstimate> estimateTurn(std::span<const TrackSightings> tracks,
                                  std::span<const Rigid3> cam_from_table,
                                  const AngleKnowledge& angles, const RecoverOptions& options,
                                  const Task& task);

}  // namespace gyre
