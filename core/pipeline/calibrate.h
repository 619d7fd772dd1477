// From pictures of a turning target, or from a live rig, to a measured rig with a verdict.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/calib/match/target_series.h"
#include "core/calib/rig/rig_bundle.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"
#include "core/pipeline/find_turning.h"
#include "core/pipeline/settling.h"
#include "core/scan/calibration_record.h"
#include "core/scan/target.h"
#include "core/scan/target_view.h"

namespace gyre {

struct CalibrateOptions {
  // Pictures in one turn of a live rig. >= 6
  int pictures = 24;
  // What is solved and how it is judged; the pictures' size is filled in.
  RigBundleOptions bundle;
  TurningOptions turning;
  // Where a live rig's pictures are kept, with angles.csv; empty: nowhere.
  std::filesystem::path keep_pictures;
};

// One picture and what was found in it: a fact to be shown while the table turns.
struct SightedPicture {
  int picture = 0;  // from 0
  int pictures = 0;
  std::string name;
  FramePtr frame;  // of a live rig; null for a file that is not kept in memory
  std::optional<TargetView> view;
  std::string reason;  // why there is no view
};

// Who watches: each is called in the calling thread where something has happened, or not set.
struct CalibrationWatcher {
  TurningWatcher on_turning;
  std::function<void(const SightedPicture&)> on_picture;
};

struct CalibrationOutcome {
  RigCalibration rig;
  std::vector<TargetView> views;                 // the pictures in which the target was found
  std::vector<std::string> skipped;              // the others: "007.png: reason"
  std::vector<std::string> remarks;              // about the table's turning, a sentence each
  std::optional<CalibratedTurntable> turntable;  // of a live rig
  std::optional<CalibratedCamera> camera;        // likewise, as it was set
  FramePtr reference;  // of a live rig: the picture taken first, by which a bump is told later
};

// Everything that a calibration file holds of the outcome. date: ISO 8601.
CalibrationRecord recordOf(const CalibrationOutcome& outcome, const std::string& date);

// Finds the target in all pictures of a turn, its points named alike in all (see findTargets).
using SeriesFinder = std::function<Result<std::vector<Result<TargetView>>>(
    const std::vector<SeriesPicture>& pictures, const Task& task)>;

// The target and how it is found.
struct SoughtTarget {
  Target target;
  TargetFinder find;      // in one picture, as a live rig takes them
  SeriesFinder find_all;  // in a folder of pictures; empty: in each by itself
};

// From pictures that were taken before, of one size. angles: none, or one a picture [rad].
struct CalibrationPictures {
  std::vector<std::filesystem::path> files;
  std::optional<std::vector<double>> angles_rad;
};

// Pictures of a folder in natural order, with the angles of a file where one is named. Fails when a
// picture is broken or has another size or no angle.
Result<CalibrationPictures> openCalibrationPictures(const std::filesystem::path& folder,
                                                    const std::filesystem::path& angles_file);

// What moved the target from picture to picture: by hand it may have been turned in any way.
enum class TargetHeld { kByTable, kByHand };

struct SightOptions {
  TargetHeld held = TargetHeld::kByTable;
  std::size_t needed = 6;  // pictures that must show it. >= 1
};

// The sightings alone. Fails with the commonest reason when fewer pictures than needed show it.
struct SightedPictures {
  std::vector<TargetView> views;
  std::vector<std::string> skipped;
};
Result<SightedPictures> sightPictures(const CalibrationPictures& pictures,
                                      const SoughtTarget& target, const SightOptions& options,
                                      const CalibrationWatcher& watcher, const Task& task);

// Looks for the target in every picture and solves the rig from those that show it. Fails with the
// commonest reason when too few do.
Result<CalibrationOutcome> calibrateFromPictures(const CalibrationPictures& pictures,
                                                 const SoughtTarget& target,
                                                 const CalibrateOptions& options,
                                                 const CalibrationWatcher& watcher,
                                                 const Task& task);

// The devices of a live rig; the target stands on the table.
struct LiveRig {
  Turntable& turntable;
  Camera& camera;
};

// Finds out how the table turns (TurningFinder), corrects it, takes pictures all around and solves.
// The turntable stays corrected: one radian told is one turned, counter-clockwise. A picture that
// does not show the target is taken again, then skipped. When it fails, and when stopped, the table
// stands; pictures taken so far are kept where that was asked for.
Result<CalibrationOutcome> calibrateLive(LiveRig rig, const SoughtTarget& target,
                                         const CalibrateOptions& options,
                                         const CalibrationWatcher& watcher, const Task& task);

}  // namespace gyre
