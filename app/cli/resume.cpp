// gyre resume: finishes a scan that was cut off.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/scan_ending.h"
#include "app/cli/subcommands.h"
#include "app/empty_table.h"
#include "app/rig.h"
#include "app/scan_run.h"
#include "core/base/clock.h"
#include "core/device/recorded_camera.h"
#include "core/io/scan_store.h"
#include "core/pipeline/find_view.h"
#include "core/sim/rig_json.h"

namespace gyre {
namespace {

struct Words {
  std::string scan;
  std::string turntable;  // empty: as before
  std::string camera;     // likewise
  double sim_speed = 10.0;
};

Error standsElsewhere() {
  return {Error::Code::kInvalidInput,
          "The table stands where no captured view shows it, so nothing was moved.",
          "Turn the table back by hand to where the scan began, and resume again."};
}

// Tells the table its angle by what the camera sees. Moves nothing.
Result<void> findAngle(Rig& rig, const ScanStore& store, const Task& task) {
  if (store.views().empty()) return rig.turntable->setAngle(store.settings().start_angle_rad);
  // A folder's pictures are those of the views: the last captured one is where it stands.
  if (auto* recorded = dynamic_cast<RecordedCamera*>(rig.camera.get())) {
    recorded->goTo(store.views().size() - 1);
  }
  const auto picture = rig.camera->grabAfter(steadySeconds(), task);
  if (!picture) return picture.error();
  const auto view = findView((*picture)->image_bgr, store, task);
  if (!view) return view.error();
  if (!*view) return standsElsewhere();
  return rig.turntable->setAngle((*view)->table_angle_rad);
}

Result<Rig> openAgain(const Words& words, const ScanStore& store, const Task& task) {
  const ScanSettings& settings = store.settings();
  RigOptions options;
  options.camera_mode = settings.camera_mode;
  options.turntable.axis = settings.axis;
  options.turntable.units_per_turn = settings.units_per_turn;
  options.turntable.direction = settings.direction;
  options.turntable.turning_measured = settings.units_per_turn != 360.0;
  options.sim_speed = words.sim_speed;
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
  auto rig = openAgain(words, store, task);
  if (!rig) return failScan(console, store, rig.error());
  tellDevices(console, *rig);
  if (rig->room) rig->room->setTable(TableLoad::kObject);
  if (const auto found = findAngle(*rig, store, task.part(0.0, 0.05)); !found) {
    return failScan(console, store, found.error());
  }
  if (const auto taken = takeEmptyTable(*rig, store, task); !taken) {
    return failScan(console, store, taken.error());
  }
  return endScan(console, store,
                 runScan(*rig->turntable, *rig->camera, store, task.part(0.05, 0.9)),
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
  command->add_option("--sim-speed", words->sim_speed, "Simulated seconds a second (default 10)")
      ->check(CLI::Range(0.1, 1000.0));
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
