// gyre scan: turns, captures, keeps and reconstructs, on a real or a simulated rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/calibrated_rig.h"
#include "app/calibration_run.h"
#include "app/cli/ask_person.h"
#include "app/cli/scan_ending.h"
#include "app/cli/scan_words.h"
#include "app/cli/subcommands.h"
#include "app/empty_table.h"
#include "app/free_hand.h"
#include "app/kept_wire_log.h"
#include "app/rig.h"
#include "app/scan_run.h"
#include "app/turntable_word.h"
#include "core/device/view_steps.h"
#include "core/io/calibration_record_file.h"
#include "core/io/scan_store.h"
#include "core/sim/rig_json.h"

namespace gyre {
namespace {

struct Words {
  ScanSettings settings;  // turntable, camera, mode, axis, views, title, rights
  std::string calibration;
  std::string background;
  std::string out;
  int mains_hz = 0;
  bool unlock = false;
  SimWords sim;
};

// Everything that can be wrong is found out before the folder is made.
struct Plan {
  ScanSettings settings;
  CalibrationRecord calibration;
  RigOptions options;
};

Result<Plan> planOf(const Words& words) {
  Plan plan;
  plan.settings = words.settings;
  plan.options.mains_hz = words.mains_hz;
  plan.options.turntable.axis = words.settings.axis;
  if (const auto valid = plan.options.turntable.validate(); !valid) return valid.error();
  plan.options.sim_speed = words.sim.speed;
  const bool simulated = namesSimulation(words.settings.turntable);
  if (simulated) {
    const auto rig = simulatedRig(words.sim, simulatedObject(words.settings.turntable));
    if (!rig) return rig.error();
    plan.options.sim = *rig;
    plan.settings.sim_rig_json = rigToJson(*rig);
    // The rig's record tells all: what the word named is found again from any folder.
    if (rig->object == "target") plan.settings.turntable = "sim";
  } else {
    plan.settings.turntable = lastingTurntableWord(words.settings.turntable);
  }
  if (!words.calibration.empty()) {
    auto calibration = readCalibrationRecord(words.calibration);
    if (!calibration) return calibration.error();
    plan.calibration = std::move(calibration).value();
  } else if (simulated && words.settings.camera == "sim") {
    plan.calibration = trueRecord(plan.options.sim);
  } else {
    return Error{Error::Code::kInvalidInput, "A real rig cannot be measured with uncalibrated.",
                 "Give its calibration with --calibration FILE."};
  }
  // A calibration holds for one mode: that one, unless another is asked for.
  std::string& mode = plan.settings.camera_mode;
  if (mode.empty() && plan.calibration.camera) mode = plan.calibration.camera->mode;
  plan.options.camera_mode = mode;
  return plan;
}

// The rig as its calibration knows it; tells when something has moved since.
Result<void> matchCalibration(const Words& words, const Rig& rig, Plan& plan, Console& console,
                              const Task& task) {
  const std::filesystem::path reference =
      words.calibration.empty() ? std::filesystem::path() : referenceFor(words.calibration);
  const auto remarks = prepareRig(rig, plan.calibration, reference, task);
  if (!remarks) return remarks.error();
  for (const std::string& remark : *remarks) console.warn(remark);
  const TurntableInfo info = rig.turntable->info();
  plan.settings.units_per_turn = info.units_per_turn;
  plan.settings.direction = info.direction;
  plan.settings.camera_controls = rig.camera->info().controls;
  return {};
}

Result<Reconstruction> scan(const Words& words, Rig& rig, ScanStore& store, Console& console,
                            const Task& task) {
  if (!words.background.empty()) {
    if (const auto kept = keepEmptyTable(words.background, store); !kept) return kept.error();
  }
  if (const auto taken = takeEmptyTable(rig, store, task); !taken) return taken.error();
  return runScan(*rig.turntable, *rig.camera, store, remarksTo(console), task);
}

int run(const Words& words, Console& console, const Task& task) {
  auto plan = planOf(words);
  if (!plan) return console.fail(plan.error());
  plan->options.ask_person = askAtTerminal(console);
  task.report(0.0, "Opening turntable and camera");
  auto rig = openRig(plan->settings.turntable, plan->settings.camera, plan->options, task);
  if (!rig) return console.fail(rig.error());
  tellDevices(console, *rig);
  if (const auto allowed = allowUnlock(*rig->turntable, unlockWord(words.unlock), console, task);
      !allowed) {
    return console.fail(allowed.error());
  }
  if (namesFreeHand(plan->settings.turntable)) {
    const auto watched =
        watchByRing(*rig, plan->calibration, plan->settings.views, tellAtTerminal(console), task);
    if (!watched) return console.fail(watched.error());
  }
  if (const auto matched = matchCalibration(words, *rig, *plan, console, task); !matched) {
    return console.fail(matched.error());
  }
  const std::string uneven =
      viewStepsRemark(rig->turntable->info().steps_per_turn, plan->settings.views);
  if (!uneven.empty()) console.warn(uneven);
  auto store = ScanStore::create(words.out, plan->settings, plan->calibration);
  if (!store) return console.fail(store.error());
  const WireLogKeeper wire(plan->settings.turntable, store->folder());
  return endScan(console, *store, scan(words, *rig, *store, console, task.part(0.0, 0.9)),
                 task.part(0.9, 1.0));
}

}  // namespace

void addScan(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  ScanSettings& settings = words->settings;
  CLI::App* command = app.add_subcommand("scan", "Scan what stands on the turntable");
  command
      ->add_option(
          "--turntable", settings.turntable,
          "[FIRMWARE:]PORT, [FIRMWARE:]tcp:HOST:PORT, FILE.json:PORT, hand[:MARKS], hand:free, "
          "sim[:OBJECT] or sim:target[:FILE]")
      ->required();
  command
      ->add_option("--camera", settings.camera,
                   "Number, /dev/video, URL, gphoto:, ptpip:HOST, folder, video or sim")
      ->required();
  command->add_option("--camera-mode", settings.camera_mode,
                      "Such as 1920x1080@MJPG (default: as calibrated)");
  command->add_option("--mains-hz", words->mains_hz, "Against lamps that flicker: 50 or 60")
      ->check(CLI::IsMember({50, 60}));
  command->add_option("--calibration", words->calibration, "calibration.json of this rig");
  command->add_option("--axis", settings.axis, "Letter of the axis that turns (default X)");
  addUnlockWord(*command, words->unlock);
  command->add_option("--background", words->background, "Picture of the empty table, or a folder");
  command->add_option("--views", settings.views, "Pictures in one turn (default 200)")
      ->check(CLI::Range(2, 100000));
  command->add_option("--title", settings.title, "What the object is");
  command->add_option("--inventory-number", settings.inventory_number, "Where it is kept");
  command->add_option("--rights", settings.rights, "Who may use the model, and how");
  command->add_option("--out", words->out, "Folder for the scan; new or empty")->required();
  addSimWords(*command, words->sim);
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
