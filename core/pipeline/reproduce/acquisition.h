// The paper's figures: a cube, a duck and a mouse, acquired on the simulated rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/experiment_table.h"
#include "core/scan/frame.h"

namespace gyre {

struct AcquisitionOptions {
  std::vector<std::string> objects = {"cube", "duck", "mouse"};
  int views = 200;  // of one turn: the paper's 1.8 deg. >= 3
  int seed = 1;
  int image_width_px = 1280;
};

struct AcquisitionFigure {
  std::string name;  // of its file, without an ending: "figure-duck"
  cv::Mat picture_bgr;
};

struct Acquisition {
  ExperimentTable table;                   // a row an object
  std::vector<AcquisitionFigure> figures;  // one an object
};

// Scans each object with the default rig's noise, motor errors and true calibration, makes its mesh
// and measures points and mesh against the truth, in % of the object's size. Each figure shows
// three sides, from the camera: the picture, the points, the surface. Leow et al. (2000),
// section 4.2, Figures 6 to 10, which give no numbers. Fails on options out of range and with
// kCancelled.
Result<Acquisition> acquisitionExperiment(const AcquisitionOptions& options, const Task& task);

}  // namespace gyre
