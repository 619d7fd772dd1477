// How far sightings are to be believed, told by how they agree.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/pipeline/candidate.h"
#include "core/recover/point_estimator.h"

namespace gyre {

// Standard deviation by which sightings miss the points that fit them best, over the focal length.
// They err by more than their pictures' noise wherever lens and axis are not known exactly: half of
// all distances tell by how much. 0 without a point. estimator: holds the views' poses. The same
// for any number of threads.
double sightingScatter(std::span<const Candidate> candidates, const PointEstimator& estimator,
                       double focal_px);

}  // namespace gyre
