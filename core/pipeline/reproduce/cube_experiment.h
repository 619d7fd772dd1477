// The paper's experiment with a real cube, on the simulated rig: calibrate on it, then measure it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/experiment_table.h"

namespace gyre {

struct CubeExperimentOptions {
  int runs = 3;                       // with other noise, motor errors and places each. >= 1
  int seed = 1;                       // of the first run
  std::vector<int> views = {20, 50};  // 1.8 deg apart, in which the corners are measured. each >= 3
  int image_width_px = 1280;
};

// Table 3: the 72 corners of a paper cube are found in pictures of the default rig, and measured
// with three calibrations: from one picture of the cube, whose place on the table is known exactly
// (the paper's way), or to half a millimetre and 0.2 deg, as a hand places it; and from 24 pictures
// of a turn, with the angles solved (Gyre's way). The paper's ways use commanded angles and least
// squared distances. Calibration error: mean distance of a point from its rays; reconstruction
// error: from the true corner; both in mm, and in % of the cube's 100 mm as the paper counts.
//
// A row for each run and number of views; rows without a run are the mean of the runs. Fails when
// a picture does not show the cube, on options out of range and with kCancelled.
// Leow et al. (2000), section 4.1, Table 3: 1 % in all, 70 % of it from calibration.
Result<ExperimentTable> cubeExperiment(const CubeExperimentOptions& options, const Task& task);

}  // namespace gyre
