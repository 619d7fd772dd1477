// gyre resume: finishes a scan that was cut off.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/ask_person.h"
#include "app/cli/scan_ending.h"
#include "app/cli/scan_words.h"
#include "app/cli/subcommands.h"
#include "app/empty_table.h"
#include "app/free_hand.h"
#include "app/kept_wire_log.h"
#include "app/rig.h"
#include "app/scan_run.h"
#include "app/take_up_scan.h"
#include "core/io/scan_store.h"
#include "core/sim/rig_json.h"

namespace gyre {
namespace {

struct Words {
  std::string scan;
  std::string turntable;  // empty: as before
  std::string camera;     // likewise
  bool trust = false;
  bool unlock = false;
  double sim_speed = 10.0;
};

Result<Rig> openAgain(const Words& words, Console& console, const ScanStore& store,
                      const Task& task) {
  const ScanSettings& settings = store.settings();
  RigOptions options;
  options.camera_mode = settings.camera_mode;
  options.turntable.axis = settings.axis;
  options.turntable.units_per_turn = settings.units_per_turn;
  options.turntable.direction = settings.direction;
  options.turntable.turning_measured = settings.units_per_turn != 360.0;
  options.sim_speed = words.sim_speed;
  options.ask_person = askAtTerminal(console);
  if (!settings.sim_rig_json.empty()) {
    const auto sim = rigFromJson(settings.sim_rig_json);
    if (!sim) return sim.error();
    options.sim = *sim;
  }
  return openRig(words.turntable.empty() ? settings.turntable : words.turntable,
                 words.camera.empty() ? settings.camera : words.camera, options, task);
}

int captureRest(const Words& words, Console& console, ScanStore& store, const Task& task) {
  task.report(0.0, "Opening turntable and camera");
  auto rig = openAgain(words, console, store, task);
  if (!rig) return failScan(console, store, rig.error());
  const WireLogKeeper wire(words.turntable.empty() ? store.settings().turntable : words.turntable,
                           store.folder());
  tellDevices(console, *rig);
  if (const auto allowed = allowUnlock(*rig->turntable, unlockWord(words.unlock), console, task);
      !allowed) {
    return failScan(console, store, allowed.error());
  }
  if (namesFreeHand(store.settings().turntable) && words.turntable.empty()) {
    const auto watched = watchByRing(*rig, store.calibrationRecord(), store.settings().views,
                                     tellAtTerminal(console), task);
    if (!watched) return failScan(console, store, watched.error());
  }
  if (rig->room) rig->room->setTable(TableLoad::kObject);
  const auto taken_up =
      takeUpScan(*rig, store, words.trust ? TakeUp::kTrust : TakeUp::kProve, task.part(0.0, 0.05));
  if (!taken_up) {
    const int code = failScan(console, store, taken_up.error());
    if (taken_up.error().code == Error::Code::kRejected) {
      console.warn(
          "`gyre resume --trust` goes on all the same: say so only when you know that "
          "nothing was touched.");
    }
    return code;
  }
  for (const std::string& remark : *taken_up) console.warn(remark);
  if (const auto taken = takeEmptyTable(*rig, store, task); !taken) {
    return failScan(console, store, taken.error());
  }
  return endScan(
      console, store,
      runScan(*rig->turntable, *rig->camera, store, remarksTo(console), task.part(0.05, 0.9)),
      task.part(0.9, 1.0));
}

int run(const Words& words, Console& console, const Task& task) {
  auto store = ScanStore::open(words.scan);
  if (!store) return console.fail(store.error());
  if (!store->complete()) return captureRest(words, console, *store, task);
  if (hasResults(*store)) {
    console.say("There is nothing to do: all " + std::to_string(store->settings().views) +
                " views are captured and reconstructed.");
    return kDone;
  }
  return endScan(console, *store, reconstructScan(*store, task.part(0.0, 0.9)),
                 task.part(0.9, 1.0));
}

}  // namespace

void addResume(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("resume", "Finish a scan that was cut off");
  command->add_option("scan", words->scan, "The scan's folder, or the .gyre file in it")
      ->required();
  command->add_option("--turntable", words->turntable, "When it is at another port than before");
  command->add_option("--camera", words->camera, "When its address needs a password, or changed");
  command->add_flag("--trust", words->trust,
                    "Go on though the pictures do not show that all stands as it stood");
  addUnlockWord(*command, words->unlock);
  command->add_option("--sim-speed", words->sim_speed, "Simulated seconds a second (default 10)")
      ->check(CLI::Range(0.1, 1000.0));
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
