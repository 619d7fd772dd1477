// A calibration from words and files to a record, without a window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/lens/calibrate_points.h"
#include "core/calib/rig/calibration_check.h"
#include "core/pipeline/calibrate.h"
#include "core/pipeline/check_before_scan.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// What is looked for and how it is judged.
struct CalibrationWords {
  std::string target;                    // a name or TARGET.json
  std::string intrinsics;                // calibration.json of the camera; empty: solved
  std::optional<double> ruler_right_mm;  // a caliper's readings of the printed rulers: both or none
  std::optional<double> ruler_down_mm;
  double object_size_mm = 80.0;
};

struct CalibrationSetup {
  SoughtTarget target;  // at its true size, as far as the rulers tell
  CalibrateOptions options;
};

// How a target is solved: as a fold-up, an exact body or loose markers, with what is known of its
// size and of the camera. Refuses a target that lies flat when the lens is not known.
Result<CalibrateOptions> optionsFor(const Target& target, bool rulers_measured,
                                    const std::optional<CameraModel>& lens);

// Reads the files that the words name. Fails with a sentence on anything that is wrong with them.
Result<CalibrationSetup> calibrationSetup(const CalibrationWords& words);

// From a file of known corners. image_size: "1280x960" or empty.
Result<CalibrationRecord> calibrateFromPointsFile(const std::filesystem::path& file,
                                                  const std::string& image_size, PointsMode mode,
                                                  const Task& task);

// Intrinsics from a folder of pictures of a target held by hand; the record has no table.
Result<CalibrationRecord> calibrateHandHeldSet(const std::filesystem::path& folder,
                                               const CalibrationWords& words,
                                               const CalibrationWatcher& watcher, const Task& task);

// Measures a target in pictures of a turn with a calibration that was made before: another target,
// or the same on another day. Both must be true to their files: nothing of them is solved.
Result<CalibrationCheck> checkByPictures(const std::filesystem::path& calibration,
                                         const CalibrationPictures& pictures,
                                         const CalibrationWords& words,
                                         const CalibrationWatcher& watcher, const Task& task);

// The picture by which a bump is told before a scan: beside the calibration, with its stem and the
// ending .png. Keeps nothing when the outcome has none.
std::filesystem::path referenceFor(const std::filesystem::path& calibration_file);
Result<void> keepReference(const std::filesystem::path& calibration_file,
                           const CalibrationOutcome& outcome);

// The present moment, ISO 8601.
std::string nowUtcText();

}  // namespace gyre
