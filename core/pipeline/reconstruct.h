// From a folder of pictures to points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/live_reconstruction.h"
#include "core/pipeline/options.h"
#include "core/pipeline/reconstruction.h"
#include "core/scan/calibration_record.h"
#include "core/scan/tracked_frame.h"

namespace gyre {

// What to reconstruct. Empty paths are "not given"; a scan brings its own calibration, angles and
// empty table, which what is given here overrides.
struct PictureSet {
  std::filesystem::path pictures;     // a folder of pictures, a scan's folder, or its .gyre file
  std::filesystem::path calibration;  // calibration.json; without one, see findCamera
  std::filesystem::path angles;       // angles.csv; without angles or step, see findAngles
  std::optional<double> step_rad;     // instead of angles: pictures in natural order, so far apart
  bool find_steps = false;            // instead of both, and of what a scan says: findAngles
  std::filesystem::path masks;        // a folder: same stem, .png, above 127 = object
  std::filesystem::path background;   // a picture of the bare table, or a folder of them
};

// A picture to be reconstructed from, not yet read.
struct PictureView {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path mask;  // empty when there is none
  double table_angle_rad = 0.0;
};

// Everything that the pictures need, checked but for the pictures' contents.
struct PreparedPictures {
  // Has no cam_from_table until it is found (findCamera), where pictures come without.
  CalibrationRecord calibration;
  FramePtr empty_table;            // may be null
  std::vector<PictureView> views;  // ascending angles
  // False where nobody told the angles, or they are not to be believed: the views are then in the
  // order of their names, at angles that say no more (findAngles).
  bool angles_told = true;
};

// Finds and checks pictures, calibration and angles. Fails, in words, when anything is missing, of
// the wrong size, ambiguous, or when the table does not turn.
Result<PreparedPictures> preparePictures(const PictureSet& set);

// Called after each view, in the calling thread.
using TrackedFrameHandler = std::function<void(const TrackedFrame&)>;

// Reads, tracks and recovers all views in order. Progress tells view i of N.
Result<Reconstruction> reconstruct(const PreparedPictures& prepared,
                                   const ReconstructOptions& options,
                                   const TrackedFrameHandler& on_frame, const Task& task);

}  // namespace gyre
