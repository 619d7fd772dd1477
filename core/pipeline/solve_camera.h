// Solves camera and axis from the object's own points, before they are measured for good.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/options.h"
#include "core/pipeline/reconstruct.h"

namespace gyre {

struct CameraKnowledge {
  bool calibrated = true;   // false: only the pictures told (findCamera), and no size is known
  bool angles_told = true;  // false: only the pictures told (findAngles)
};

struct SolvedCamera {
  double focal_px = 0.0;
  double focal_sigma_px = 0.0;  // standard deviation
  double rms_before_px = 0.0;   // of the same sightings
  double rms_after_px = 0.0;
};

// Reconstructs features alone, and solves for the camera and the angles that agree with them best
// (selfCalibrate); once more where nobody calibrated, as features are found better then. Sets
// calibration and angles of the pictures; what is not calibrated is scaled to the unknown size.
// Changes nothing when it fails: when there are too few points, a picture cannot be read, or the
// task is stopped.
Result<SolvedCamera> solveCamera(PreparedPictures& prepared, const ReconstructOptions& options,
                                 const CameraKnowledge& known, const Task& task);

}  // namespace gyre
