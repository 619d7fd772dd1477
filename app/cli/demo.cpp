// gyre demo: a whole scan on the simulated rig, then measured against the truth.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/calibrated_rig.h"
#include "app/calibration_run.h"
#include "app/cli/calibrate_ending.h"
#include "app/cli/scan_ending.h"
#include "app/cli/scan_words.h"
#include "app/cli/subcommands.h"
#include "app/demo_truth.h"
#include "app/empty_table.h"
#include "app/rig.h"
#include "app/scan_run.h"
#include "core/base/clock.h"
#include "core/device/streaming_camera.h"
#include "core/io/scan_store.h"
#include "core/sim/object_models.h"
#include "core/sim/rig_json.h"

namespace gyre {
namespace {

struct Words {
  std::string object;
  int views = 200;
  bool calibrate = false;
  std::string out;
  SimWords sim;
};

ScanSettings settingsFor(const RigSettings& rig, int views) {
  ScanSettings settings;
  settings.title = "Demo: " + rig.object;
  settings.turntable = "sim:" + rig.object;
  settings.camera = "sim";
  settings.sim_rig_json = rigToJson(rig);
  settings.views = views;
  return settings;
}

Result<Reconstruction> scan(Rig& rig, ScanStore& store, const Task& task) {
  task.report(0.0, "Taking a picture of the empty table");
  if (const auto taken = takeEmptyTable(rig, store, task); !taken) return taken.error();
  auto points = runScan(*rig.turntable, *rig.camera, store, task);
  const auto* camera = dynamic_cast<const StreamingCamera*>(rig.camera.get());
  if (points && camera != nullptr) points->seconds["render"] = camera->decodingSeconds();
  return points;
}

// Turns a target on the same rig first, as a user would.
Result<CalibrationRecord> calibrationOf(const RigSettings& sim, const Words& words,
                                        Console& console, const Task& task) {
  if (!words.calibrate) return trueRecord(sim);
  CalibrationWords what;
  what.target = "wedge";
  const auto setup = calibrationSetup(what);
  if (!setup) return setup.error();
  RigOptions options;
  options.sim = sim;
  options.sim.object = "target";
  options.sim.target = what.target;
  options.sim_speed = words.sim.speed;
  auto rig = openRig("sim", "sim", options, task);
  if (!rig) return rig.error();
  rig->room->setTable(TableLoad::kObject);
  const auto outcome =
      calibrateLive({*rig->turntable, *rig->camera}, setup->target, setup->options, {}, task);
  if (!outcome) return outcome.error();
  tellOutcome(console, *outcome);
  tellVerdict(console, outcome->rig.report);
  return recordOf(*outcome, nowUtcText());
}

int run(const Words& words, Console& console, const Task& task) {
  const double start_s = steadySeconds();
  const auto settings = simulatedRig(words.sim, words.object);
  if (!settings) return console.wrongUse(settings.error());
  const auto calibration =
      calibrationOf(*settings, words, console, task.part(0.0, words.calibrate ? 0.2 : 0.0));
  if (!calibration) return console.fail(calibration.error());
  auto store = ScanStore::create(words.out, settingsFor(*settings, words.views), *calibration);
  if (!store) return console.fail(store.error());
  RigOptions options;
  options.sim = *settings;
  options.sim_speed = words.sim.speed;
  task.report(0.0, "Building the simulated rig");
  auto rig = openRig(store->settings().turntable, "sim", options, task);
  if (!rig) return console.fail(rig.error());
  if (const auto matched = applyCalibration(*rig, *calibration); !matched) {
    return console.fail(matched.error());
  }
  const auto reconstruction = scan(*rig, *store, task.part(words.calibrate ? 0.2 : 0.0, 0.85));
  if (!reconstruction) return failScan(console, *store, reconstruction.error());
  const auto written = writeScanResults(*store, *reconstruction, task.part(0.85, 0.92));
  if (!written) return failScan(console, *store, written.error());
  tellResults(console, *reconstruction, *written);
  const auto judged =
      judgeDemo(*rig->room->renderer, *store, *reconstruction, task.part(0.92, 1.0));
  if (!judged) return failScan(console, *store, judged.error());
  console.say(judgementText(*judged));
  console.say("All files are in " + store->folder().string() + ", after " +
              secondsText(steadySeconds() - start_s) + ".");
  const auto enough = enoughPoints(reconstruction->cloud, store->views().size());
  return enough ? static_cast<int>(kDone) : console.fail(enough.error());
}

}  // namespace

void addDemo(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand(
      "demo", "Scan a simulated object and measure the result against the truth");
  command->add_option("--object", words->object, "What stands on the table (default duck)")
      ->check(CLI::IsMember(objectNames()));
  command->add_option("--views", words->views, "Pictures in one turn (default 200)")
      ->check(CLI::Range(2, 100000));
  command->add_flag("--calibrate", words->calibrate,
                    "Turn a target first and use that calibration instead of the true one");
  command->add_option("--out", words->out, "Folder for the scan; new or empty")->required();
  addSimWords(*command, words->sim);
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
