// The paper's synthetic experiments: how far points are off when pixels or angles are noisy.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/experiment_table.h"

namespace gyre {

struct NoiseExperimentOptions {
  int trials = 200;                                    // of twenty points each. >= 1
  std::uint64_t seed = 1;                              // another one draws other points and noise
  std::vector<int> views = {5, 10, 20, 50, 100, 200};  // lengths of the tracks. each >= 3
};

// Table 1: noise of 0, 1, 3 and 5 px on top of coordinates rounded to whole pixels; exact angles.
// Table 2: noise of 0 to 1 deg of every angle but the first; coordinates rounded to whole pixels.
//
// A row for each noise and number of views: the mean distance in mm between a point found and the
// true one, by each solver and with the angles solved jointly, the Cramer-Rao bounds of both, and
// the paper's printed cell. Points are found one by one except where the column says jointly; that
// column and its bound are judged after the best turn about the axis, for the angle of the whole
// is a choice of the frame. A solver that gives no point has lost it: `lost` is the worst share.
//
// Fails on options out of range and with kCancelled. The same table for any number of threads.
// Leow et al. (2000), section 4.1.
Result<ExperimentTable> pixelNoiseExperiment(const NoiseExperimentOptions& options,
                                             const Task& task);
Result<ExperimentTable> angleNoiseExperiment(const NoiseExperimentOptions& options,
                                             const Task& task);

}  // namespace gyre
