// gyre calibrate: camera and table from a target, in pictures or on a live rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/calibration_run.h"
#include "app/cli/ask_person.h"
#include "app/cli/calibrate_ending.h"
#include "app/cli/scan_ending.h"
#include "app/cli/scan_words.h"
#include "app/cli/subcommands.h"
#include "app/rig.h"
#include "app/turntable_word.h"
#include "core/io/frame_folder.h"

namespace gyre {
namespace {

struct Words {
  CalibrationWords what;
  std::string pictures;
  std::string angles;
  bool hand_held = false;
  std::string points;
  std::string image_size;
  bool tsai = false;
  std::string turntable;
  std::string camera;
  RigOptions rig;
  bool unlock = false;
  int turns_pictures = 24;
  std::string keep;
  std::string check;
  std::string out;
  SimWords sim;
};

Error wrongWords(std::string what, std::string advice) {
  return {Error::Code::kInvalidInput, std::move(what), std::move(advice)};
}

// Which of the four ways is meant, and that nothing of another is asked for.
Result<void> checkWords(const Words& words) {
  const bool live = !words.turntable.empty() || !words.camera.empty();
  const int ways =
      (words.pictures.empty() ? 0 : 1) + (live ? 1 : 0) + (words.points.empty() ? 0 : 1);
  if (ways != 1) {
    return wrongWords(ways == 0 ? "Nothing says what to calibrate from."
                                : "Two ways to calibrate are asked for at once.",
                      "Give a folder of pictures, or --turntable and --camera, or --points FILE.");
  }
  if (live && (words.turntable.empty() || words.camera.empty())) {
    return wrongWords("A live rig is a turntable and a camera.",
                      "Give both --turntable and --camera.");
  }
  if (words.points.empty() && words.what.target.empty()) {
    return wrongWords("Nothing says which target is in the pictures.",
                      "Give --target with TARGET.json, or with the name of a printed target.");
  }
  if (words.out.empty() == words.check.empty()) {
    return wrongWords("Nothing says whether to calibrate or to check.",
                      "Give either --out for a new calibration, or --check with an older one.");
  }
  if (!words.check.empty() && (words.pictures.empty() || words.hand_held)) {
    return wrongWords("A calibration is checked by pictures of a target that turns on the table.",
                      "Give a folder of them beside --check.");
  }
  if (words.hand_held && (words.pictures.empty() || !words.angles.empty())) {
    return wrongWords("A hand-held set is a folder of pictures, without angles.",
                      "Leave out --hand-held for a target that turns on the table.");
  }
  if (words.what.ruler_right_mm.has_value() != words.what.ruler_down_mm.has_value()) {
    return wrongWords("Only one of the two printed rulers is given.",
                      "Measure both: --ruler-right and --ruler-down.");
  }
  return {};
}

// Told as they come, so that a wrong target is not found out after a whole turn.
CalibrationWatcher watcherOf(Console& console) {
  CalibrationWatcher watcher;
  watcher.on_turning = [&console](double told_rad, double turned_rad) {
    console.note(turningText(told_rad, turned_rad));
  };
  watcher.on_picture = [&console](const SightedPicture& picture) {
    console.note(pictureText(picture));
  };
  return watcher;
}

int fromPoints(const Words& words, Console& console, const Task& task) {
  auto record = calibrateFromPointsFile(words.points, words.image_size,
                                        words.tsai ? PointsMode::kTsai : PointsMode::kFull, task);
  if (!record) return console.fail(record.error());
  return endCalibration(console, words.out, *record);
}

int fromHand(const Words& words, Console& console, const Task& task) {
  auto record = calibrateHandHeldSet(words.pictures, words.what, watcherOf(console), task);
  if (!record) return console.fail(record.error());
  return endCalibration(console, words.out, *record);
}

int fromPictures(const Words& words, Console& console, const Task& task) {
  const auto setup = calibrationSetup(words.what);
  if (!setup) return console.fail(setup.error());
  const auto pictures = openCalibrationPictures(words.pictures, words.angles);
  if (!pictures) return console.fail(pictures.error());
  const auto outcome =
      calibrateFromPictures(*pictures, setup->target, setup->options, watcherOf(console), task);
  if (!outcome) return console.fail(outcome.error());
  tellOutcome(console, *outcome);
  return endCalibration(console, words.out, recordOf(*outcome, nowUtcText()));
}

int check(const Words& words, Console& console, const Task& task) {
  const auto pictures = openCalibrationPictures(words.pictures, words.angles);
  if (!pictures) return console.fail(pictures.error());
  const auto checked =
      checkByPictures(words.check, *pictures, words.what, watcherOf(console), task);
  if (!checked) return console.fail(checked.error());
  console.say(checked->sentence);
  const double allowed_mm = VerdictLimits{}.acceptable_detail * words.what.object_size_mm;
  if (checked->error_mm <= allowed_mm) return kDone;
  std::ostringstream allowed;
  allowed << std::fixed << std::setprecision(3) << allowed_mm;
  return console.fail({Error::Code::kTooFew,
                       "That is more than the " + allowed.str() + " mm that objects allow.",
                       "Calibrate again: camera or table have moved, or the target is not what its "
                       "file says."});
}

int fromRig(const Words& words, Console& console, const Task& task) {
  auto setup = calibrationSetup(words.what);
  if (!setup) return console.fail(setup.error());
  setup->options.pictures = words.turns_pictures;
  setup->options.keep_pictures = words.keep;
  RigOptions options = words.rig;
  options.sim_speed = words.sim.speed;
  if (namesSimulation(words.turntable)) {
    const auto sim = simulatedRig(words.sim, simulatedObject(words.turntable));
    if (!sim) return console.wrongUse(sim.error());
    options.sim = *sim;
  }
  const auto table = turntableWord(words.turntable);
  if (table && table->port.empty()) {
    return console.wrongUse({Error::Code::kInvalidInput,
                             "A table turned by hand is calibrated from pictures.",
                             "Take them at known angles, and give their folder and --angles."});
  }
  task.report(0.0, "Opening turntable and camera");
  auto rig = openRig(words.turntable, words.camera, options, task);
  if (!rig) return console.fail(rig.error());
  tellDevices(console, *rig);
  if (const auto allowed = allowUnlock(*rig->turntable, unlockWord(words.unlock), console, task);
      !allowed) {
    return console.fail(allowed.error());
  }
  if (rig->room) rig->room->setTable(TableLoad::kObject);
  const auto outcome = calibrateLive({*rig->turntable, *rig->camera}, setup->target, setup->options,
                                     watcherOf(console), task);
  if (!outcome) return console.fail(outcome.error());
  (void)rig->turntable->release();  // that the motor stays on does not spoil the calibration
  tellOutcome(console, *outcome);
  if (const auto kept = keepReference(words.out, *outcome); !kept) {
    return console.fail(kept.error());
  }
  return endCalibration(console, words.out, recordOf(*outcome, nowUtcText()));
}

int run(const Words& words, Console& console, const Task& task) {
  if (const auto valid = checkWords(words); !valid) return console.wrongUse(valid.error());
  if (const auto valid = words.rig.turntable.validate(); !valid) {
    return console.wrongUse(valid.error());
  }
  if (!words.points.empty()) return fromPoints(words, console, task);
  if (!words.check.empty()) return check(words, console, task);
  if (words.hand_held) return fromHand(words, console, task);
  return words.pictures.empty() ? fromRig(words, console, task)
                                : fromPictures(words, console, task);
}

void addPictureWords(CLI::App& command, Words& words) {
  command.add_option("pictures", words.pictures, "Folder of pictures of the turning target");
  command.add_option(
      "--target", words.what.target,
      "TARGET.json, or the name of a printed target: wedge, coded-cube, cube, flat, ring");
  command.add_option("--angles", words.angles, "angles.csv: image,angle_deg, if they are known");
  command.add_flag("--hand-held", words.hand_held,
                   "The target was held before the camera: intrinsics alone, no table");
  command.add_option("--intrinsics", words.what.intrinsics,
                     "calibration.json of the camera, kept as it is; admits flat targets");
  command.add_option("--ruler-right", words.what.ruler_right_mm,
                     "What a caliper shows of the printed ruler along the page's width, mm");
  command.add_option("--ruler-down", words.what.ruler_down_mm, "Likewise along its height, mm");
  command.add_option("--object-size", words.what.object_size_mm,
                     "Size of the objects to be scanned, mm (default 80)");
}

void addRigWords(CLI::App& command, Words& words) {
  command.add_option("--turntable", words.turntable,
                     "[FIRMWARE:]PORT, [FIRMWARE:]tcp:HOST:PORT, FILE.json:PORT or "
                     "sim:target[:TARGET]; the target stands on it");
  command.add_option("--camera", words.camera, "Number, /dev/video, URL or sim");
  command.add_option("--camera-mode", words.rig.camera_mode,
                     "Such as 1920x1080@MJPG (default: the largest at 5 pictures a second)");
  command.add_option("--mains-hz", words.rig.mains_hz, "Against lamps that flicker: 50 or 60")
      ->check(CLI::IsMember({50, 60}));
  command.add_option("--axis", words.rig.turntable.axis,
                     "Letter of the axis that turns (default X)");
  addUnlockWord(command, words.unlock);
  command.add_option("--pictures", words.turns_pictures, "Pictures in one turn (default 24)")
      ->check(CLI::Range(6, 1000));
  command.add_option("--keep", words.keep, "Folder to keep the pictures in, with angles.csv");
  addSimWords(command, words.sim);
}

}  // namespace

void addCalibrate(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Measure camera and turntable by a target, with a verdict");
  addPictureWords(*command, *words);
  addRigWords(*command, *words);
  command->add_option("--points", words->points,
                      "Known corners instead of pictures: a line `X Y Z u v` each, mm and px");
  command->add_option("--image-size", words->image_size, "With --points: such as 1280x960");
  command->add_flag("--tsai", words->tsai, "With --points: Tsai's method alone, as in the paper");
  command->add_option(
      "--check", words->check,
      "Write nothing, but measure the target in the pictures with this calibration");
  command->add_option("--out", words->out, "calibration.json to write");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
