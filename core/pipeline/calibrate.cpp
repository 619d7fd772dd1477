// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/calibrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <system_error>
#include <utility>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 3;  // of one stop of the table
// A ratio as near to 1 as this is the solver's own uncertainty, not the motor's.
constexpr double kScaleWorthCorrecting = 5e-4;

std::string countText(std::size_t count, std::size_t of) {
  return std::to_string(count) + " of " + std::to_string(of) + " pictures";
}

// What was found so far, and why the rest was not.
class Sightings {
 public:
  Sightings(int pictures, const CalibrationWatcher& watcher)
      : pictures_(pictures), watcher_(watcher) {}

  void found(const FramePtr& frame, TargetView view) {
    tell(frame, view, "");
    views.push_back(std::move(view));
  }
  void missed(const FramePtr& frame, const std::string& name, const Error& reason) {
    tell(frame, std::nullopt, reason.what);
    skipped.push_back(name + ": " + reason.what);
    ++reasons_[reason.sentence()];
  }

  // Fails with the reason that came most often.
  Result<void> checkEnough(std::size_t needed) const {
    if (views.size() >= needed) return {};
    std::string what = "The target was found in only " +
                       countText(views.size(), static_cast<std::size_t>(pictures_)) + ", and " +
                       std::to_string(needed) + " are needed.";
    const auto commonest =
        std::max_element(reasons_.begin(), reasons_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return Error{Error::Code::kTooFew, std::move(what),
                 commonest == reasons_.end() ? "Take more pictures of the turning target."
                                             : commonest->first};
  }

  std::vector<TargetView> views;
  std::vector<std::string> skipped;

 private:
  void tell(const FramePtr& frame, std::optional<TargetView> view, const std::string& reason) {
    if (watcher_.on_picture) {
      watcher_.on_picture({number_, pictures_, frame, std::move(view), reason});
    }
    ++number_;
  }

  int pictures_;
  int number_ = 0;
  const CalibrationWatcher& watcher_;
  std::map<std::string, int> reasons_;
};

Result<Sightings> sightAll(const CalibrationPictures& pictures, const SoughtTarget& target,
                           const CalibrationWatcher& watcher, const Task& task) {
  const std::size_t count = pictures.files.size();
  Sightings sightings(static_cast<int>(count), watcher);
  for (std::size_t i = 0; i < count; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(count),
                "Picture " + std::to_string(i + 1) + " of " + std::to_string(count));
    auto read = readPicture(pictures.files[i]);
    if (!read) return read.error();
    if (pictures.angles_rad) read->table_angle_rad = (*pictures.angles_rad)[i];
    const auto frame = std::make_shared<const Frame>(std::move(*read));
    auto view = target.find(frame->image_bgr);
    if (!view) {
      if (view.error().code == Error::Code::kCancelled) return view.error();
      sightings.missed(frame, frame->name, view.error());
      continue;
    }
    view->name = frame->name;
    if (pictures.angles_rad) view->table_angle_rad = (*pictures.angles_rad)[i];
    sightings.found(frame, std::move(*view));
  }
  return sightings;
}

Result<CalibrationOutcome> solve(Sightings sightings, const Target& target,
                                 const RigBundleOptions& options, const Task& task) {
  if (const auto enough = sightings.checkEnough(options.min_views); !enough) return enough.error();
  task.report(0.0, "Solving camera, axis and angles");
  auto rig = calibrateRig(sightings.views, target, options, task);
  if (!rig) return rig.error();
  CalibrationOutcome outcome;
  outcome.rig = std::move(*rig);
  outcome.views = std::move(sightings.views);
  outcome.skipped = std::move(sightings.skipped);
  return outcome;
}

RigBundleOptions bundleFor(const CalibrateOptions& options, int width_px, int height_px) {
  RigBundleOptions bundle = options.bundle;
  bundle.image_width_px = width_px;
  bundle.image_height_px = height_px;
  return bundle;
}

std::string pictureName(int picture) {
  std::array<char, 16> name{};
  std::snprintf(name.data(), name.size(), "%03d.png", picture + 1);
  return name.data();
}

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
  Result<CalibrationOutcome> solveAndCorrect(Sightings sightings, const Task& task);
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
Result<CalibrationOutcome> LiveCalibration::solveAndCorrect(Sightings sightings, const Task& task) {
  const RigBundleOptions bundle =
      bundleFor(options_, reference_->image_bgr.cols, reference_->image_bgr.rows);
  auto outcome = solve(sightings, target_.target, bundle, task.part(0.0, 0.5));
  if (!outcome) return outcome;
  const double left_over = outcome->rig.report.direction * outcome->rig.report.step_scale;
  if (std::abs(left_over - 1.0) <= kScaleWorthCorrecting) return outcome;
  if (auto done = rig_.turntable.correct(left_over); !done) return done.error();
  for (TargetView& view : sightings.views) *view.table_angle_rad *= left_over;
  return solve(std::move(sightings), target_.target, bundle, task.part(0.5, 1.0));
}

Result<CalibrationOutcome> LiveCalibration::run(const Task& task) {
  auto turning = findTurning(task.part(0.0, 0.3));
  if (!turning) return turning.error();
  auto sightings = takePictures(task.part(0.3, 0.9));
  if (!sightings) return sightings.error();
  auto outcome = solveAndCorrect(std::move(*sightings), task.part(0.9, 1.0));
  if (!outcome) return outcome;
  outcome->remarks = std::move(turning->remarks);
  outcome->reference = reference_;
  const TurntableInfo info = rig_.turntable.info();
  outcome->turntable =
      CalibratedTurntable{info.device_id, info.axis, info.units_per_turn, info.direction};
  return outcome;
}

}  // namespace

CalibrationRecord recordOf(const CalibrationOutcome& outcome, const std::string& date) {
  CalibrationRecord record;
  record.calibration = outcome.rig.calibration;
  record.date = date;
  record.target = outcome.rig.target.name;
  record.report = outcome.rig.report;
  record.covariance = NamedCovariance{outcome.rig.parameter_names, outcome.rig.covariance};
  record.table_from_target = outcome.rig.table_from_target;
  record.turntable = outcome.turntable;
  return record;
}

Result<CalibrationPictures> openCalibrationPictures(const fs::path& folder,
                                                    const fs::path& angles_file) {
  auto files = listPictures(folder);
  if (!files) return files.error();
  if (const auto size = commonSize(*files); !size) return size.error();
  CalibrationPictures pictures;
  if (!angles_file.empty()) {
    const auto table = readAngles(angles_file);
    if (!table) return table.error();
    auto angles_rad = anglesOfPictures(*files, *table);
    if (!angles_rad) return angles_rad.error();
    pictures.angles_rad = std::move(*angles_rad);
  }
  pictures.files = std::move(*files);
  return pictures;
}

Result<CalibrationOutcome> calibrateFromPictures(const CalibrationPictures& pictures,
                                                 const SoughtTarget& target,
                                                 const CalibrateOptions& options,
                                                 const CalibrationWatcher& watcher,
                                                 const Task& task) {
  const auto size = commonSize(pictures.files);
  if (!size) return size.error();
  auto sightings = sightAll(pictures, target, watcher, task.part(0.0, 0.8));
  if (!sightings) return sightings.error();
  return solve(std::move(*sightings), target.target,
               bundleFor(options, size->width_px, size->height_px), task.part(0.8, 1.0));
}

Result<CalibrationOutcome> calibrateLive(LiveRig rig, const SoughtTarget& target,
                                         const CalibrateOptions& options,
                                         const CalibrationWatcher& watcher, const Task& task) {
  auto outcome = LiveCalibration(rig, target, options, watcher).run(task);
  if (!outcome) rig.turntable.stop();
  return outcome;
}

Result<SightedPictures> sightPictures(const CalibrationPictures& pictures,
                                      const SoughtTarget& target, const CalibrationWatcher& watcher,
                                      const Task& task) {
  auto sightings = sightAll(pictures, target, watcher, task);
  if (!sightings) return sightings.error();
  if (const auto enough = sightings->checkEnough(3); !enough) return enough.error();
  return SightedPictures{std::move(sightings->views), std::move(sightings->skipped)};
}

}  // namespace gyre
