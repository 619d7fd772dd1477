// A calibration on a live rig: how the table turns, pictures all around it, the solution.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>
#include <system_error>
#include <utility>

#include "core/base/clock.h"
#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/picture_file.h"
#include "core/pipeline/calibrate.h"
#include "core/pipeline/check_before_scan.h"
#include "core/pipeline/measured_turntable.h"
#include "core/pipeline/sightings.h"
#include "core/pipeline/solve_and_check.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 3;  // of one stop of the table
// A ratio as near to 1 as this is the solver's own uncertainty, not the motor's.
constexpr double kScaleWorthCorrecting = 5e-4;

std::string pictureName(int picture) { return formatted("%03d.png", picture + 1); }

// The pictures of a live calibration, where they are to be kept.
class Keeper {
 public:
  explicit Keeper(fs::path folder) : folder_(std::move(folder)) {}

  Result<void> open() const {
    if (folder_.empty()) return {};
    std::error_code problem;
    fs::create_directories(folder_, problem);
    if (!problem) return {};
    return Error{Error::Code::kIo, "The folder \"" + folder_.string() + "\" cannot be made.",
                 "Choose a folder in which you may write."};
  }
  Result<void> keep(const Frame& frame) {
    if (folder_.empty()) return {};
    angles_[frame.name] = frame.table_angle_rad;
    if (auto done = writePicture(folder_ / frame.name, frame.image_bgr); !done) return done;
    return writeAngles(folder_ / "angles.csv", angles_);
  }

 private:
  fs::path folder_;
  AngleTable angles_;
};

// One live calibration: the table has been corrected, the target is in view.
class LiveCalibration {
 public:
  LiveCalibration(LiveRig rig, const SoughtTarget& target, const CalibrateOptions& options,
                  const CalibrationWatcher& watcher)
      : rig_(rig), target_(target), options_(options), watcher_(watcher) {}

  Result<CalibrationOutcome> run(const Task& task);

 private:
  Result<FoundTurning> findTurning(const Task& task);
  Result<Sightings> takePictures(const Task& task);
  Result<CalibrationOutcome> solveAndCorrect(std::vector<TargetView> views, const Task& task);
  Result<void> takePicture(int picture, Keeper& keeper, Sightings& sightings, const Task& task);

  LiveRig rig_;
  const SoughtTarget& target_;
  const CalibrateOptions& options_;
  const CalibrationWatcher& watcher_;
  Settling settling_;
  FramePtr reference_;
};

Result<FoundTurning> LiveCalibration::findTurning(const Task& task) {
  TurningFinder finder(rig_.turntable, rig_.camera, target_.target, target_.find);
  finder.watch(watcher_.on_turning);
  auto found = finder.find(options_.turning, task);
  if (!found) return found;
  if (auto done = rig_.turntable.correct(found->turned_over_told); !done) return done.error();
  takeUpBacklash(rig_.turntable, found->backlash_rad);
  return found;
}

Result<void> LiveCalibration::takePicture(int picture, Keeper& keeper, Sightings& sightings,
                                          const Task& task) {
  if (auto moved = rig_.turntable.moveTo(kTurn_rad * picture / options_.pictures, task); !moved) {
    return moved;
  }
  std::optional<Error> reason;
  FramePtr named;
  for (int i = 0; i < kTries; ++i) {
    auto grabbed = settling_.grabStill(rig_.camera, steadySeconds(), task);
    if (!grabbed) return grabbed.error();
    Frame frame = **grabbed;
    frame.name = pictureName(picture);
    frame.view = picture;
    frame.table_angle_rad = rig_.turntable.angleRad();
    named = std::make_shared<const Frame>(std::move(frame));
    if (!reference_) reference_ = named;
    auto view = target_.find(named->image_bgr);
    if (task.stopRequested()) return cancelled();
    if (!view) {
      reason = view.error();
      continue;
    }
    view->name = named->name;
    view->table_angle_rad = named->table_angle_rad;
    sightings.found(named, std::move(*view));
    return keeper.keep(*named);
  }
  sightings.missed(named, named->name, *reason);
  return keeper.keep(*named);
}

Result<Sightings> LiveCalibration::takePictures(const Task& task) {
  Keeper keeper(options_.keep_pictures);
  if (const auto opened = keeper.open(); !opened) return opened.error();
  Sightings sightings(options_.pictures, watcher_);
  const Task silent(task.stopToken());
  for (int picture = 0; picture < options_.pictures; ++picture) {
    task.report(static_cast<double>(picture) / options_.pictures,
                "Picture " + std::to_string(picture + 1) + " of " +
                    std::to_string(options_.pictures) + ", target found in " +
                    std::to_string(sightings.views.size()));
    if (const auto taken = takePicture(picture, keeper, sightings, silent); !taken) {
      return taken.error();
    }
  }
  return sightings;
}

// What the rough lens of the tiny moves left over is put right in the device and in the told
// angles, and solved again: then the report is that of the table as it is from now on.
Result<CalibrationOutcome> LiveCalibration::solveAndCorrect(std::vector<TargetView> views,
                                                            const Task& task) {
  RigBundleOptions bundle = options_.bundle;
  bundle.image_width_px = reference_->image_bgr.cols;
  bundle.image_height_px = reference_->image_bgr.rows;
  auto outcome = solveAndCheck(views, target_.target, bundle, task.part(0.0, 0.5));
  if (!outcome) return outcome;
  const double left_over = outcome->rig.report.direction * outcome->rig.report.step_scale;
  if (std::abs(left_over - 1.0) <= kScaleWorthCorrecting) return outcome;
  if (auto done = rig_.turntable.correct(left_over); !done) return done.error();
  for (TargetView& view : views) *view.table_angle_rad *= left_over;
  return solveAndCheck(views, target_.target, bundle, task.part(0.5, 1.0));
}

Result<CalibrationOutcome> LiveCalibration::run(const Task& task) {
  auto turning = findTurning(task.part(0.0, 0.3));
  if (!turning) return turning.error();
  auto sightings = takePictures(task.part(0.3, 0.9));
  if (!sightings) return sightings.error();
  if (const auto enough = sightings->checkEnough(options_.bundle.min_views); !enough) {
    return enough.error();
  }
  auto outcome = solveAndCorrect(std::move(sightings->views), task.part(0.9, 1.0));
  if (!outcome) return outcome;
  outcome->skipped = std::move(sightings->skipped);
  outcome->remarks = std::move(turning->remarks);
  outcome->reference = reference_;
  outcome->camera = calibratedCamera(rig_.camera.info());
  const TurntableInfo info = rig_.turntable.info();
  outcome->turntable = CalibratedTurntable{info.device_id,        info.axis,
                                           info.units_per_turn,   info.direction,
                                           turning->backlash_rad, settling_.delaySeconds()};
  return outcome;
}

}  // namespace

Result<CalibrationOutcome> calibrateLive(LiveRig rig, const SoughtTarget& target,
                                         const CalibrateOptions& options,
                                         const CalibrationWatcher& watcher, const Task& task) {
  auto outcome = LiveCalibration(rig, target, options, watcher).run(task);
  if (!outcome) rig.turntable.stop();
  return outcome;
}

}  // namespace gyre
