// gyre devices: ports and cameras, listed without opening any, and what is the matter with a port.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/ask_person.h"
#include "app/cli/device_words.h"
#include "app/cli/scan_words.h"
#include "app/cli/subcommands.h"
#include "app/port_check.h"
#include "app/rig.h"
#include "app/turntable_word.h"
#include "core/device/discovery.h"
#include "core/device/port_doctor.h"
#include "core/pipeline/watch_motor.h"

namespace gyre {
namespace {

struct Words {
  bool json = false;
  std::string probe;
  std::string watch;  // a camera; empty: nothing is moved
  bool unlock = false;
};

bool isUsable(PortState state) {
  return state == PortState::kTurntable || state == PortState::kHindered ||
         state == PortState::kLocked;
}

// Turns the table before the camera: a motor that stands is told as such. Nothing when it turns.
Result<std::optional<PortDiagnosis>> watchTheMotor(const Words& words, CheckedPort& probed,
                                                   Console& console, const Task& task) {
  const RigOptions options;
  const auto camera = openCamera(words.watch, options, nullptr);
  if (!camera) return camera.error();
  if (const auto allowed = allowUnlock(*probed.table, unlockWord(words.unlock), console, task);
      !allowed) {
    return allowed.error();
  }
  const auto seen = watchMotor(*probed.table, **camera, task);
  if (!seen) return seen.error();
  (void)probed.table->release();
  if (seen->turns) return std::optional<PortDiagnosis>();
  PortDiagnosis stands = diagnoseMotor(probed.diagnosis.port, motorStands(seen->told_rad));
  stands.firmware = probed.diagnosis.firmware;
  stands.baud = probed.diagnosis.baud;
  stands.steps_per_turn = probed.diagnosis.steps_per_turn;
  stands.hindrances = probed.diagnosis.hindrances;
  stands.answers = probed.diagnosis.answers;
  return std::optional(stands);
}

int probe(const Words& words, Console& console, const Task& task) {
  const auto word = turntableWord(words.probe);
  if (!word) return console.wrongUse(word.error());
  if (word->port.empty()) {
    return console.wrongUse({Error::Code::kInvalidInput, "A table turned by hand has no port.",
                             "Name a port, such as /dev/ttyUSB0."});
  }
  CheckedPort probed = checkPort(*word, task);
  if (task.stopRequested()) return console.fail(cancelled());
  if (!words.watch.empty() && probed.table) {
    auto stands = watchTheMotor(words, probed, console, task);
    if (!stands) return console.fail(stands.error());
    if (*stands) probed.diagnosis = **std::move(stands);
  }
  const PortDiagnosis& found = probed.diagnosis;
  const bool usable = isUsable(found.state);
  if (words.json) {
    console.sayAlways(diagnosisJson(found));
    return usable ? kDone : kFailed;
  }
  if (usable) {
    tellDiagnosis(console, found);
    if (!words.watch.empty()) console.say("    Its motor turns: the camera saw it.");
    return kDone;
  }
  tellAnswers(console, found.answers);
  return console.fail({Error::Code::kRejected, found.what, found.advice});
}

int run(const Words& words, Console& console, const Task& task) {
  if (words.probe.empty() && !words.watch.empty()) {
    return console.wrongUse({Error::Code::kInvalidInput, "Nothing says which port to watch.",
                             "Give --probe PORT beside --watch CAMERA."});
  }
  if (!words.probe.empty()) return probe(words, console, task);
  std::vector<ListedPort> ports;
  for (const PortInfo& port : listPorts()) ports.push_back({port, diagnosePort(port.path)});
  const auto adapters = diagnoseAdapters();
  const auto cameras = listCameras();
  if (words.json) {
    console.sayAlways(devicesJson(ports, adapters, cameras));
    return kDone;
  }
  tellPorts(console, ports, adapters);
  tellCameras(console, cameras);
  console.say("Always there: the simulated rig, as --turntable sim --camera sim.");
  return kDone;
}

}  // namespace

void addDevices(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("devices", "List ports and cameras without opening them");
  command->add_flag("--json", words->json, "As JSON");
  command
      ->add_option("--probe", words->probe,
                   "Find out what answers at this port, [FIRMWARE:]PORT; moves nothing")
      ->check([](const std::string& port) {
        return namesSimulation(port) ? "sim is always there; name a port" : "";
      });
  command->add_option(
      "--watch", words->watch,
      "With --probe: turn the table a little before this camera, to see whether its "
      "motor turns");
  addUnlockWord(*command, words->unlock);
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
