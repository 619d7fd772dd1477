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

#include "app/cli/device_words.h"
#include "app/cli/subcommands.h"
#include "app/rig.h"
#include "app/table_at_port.h"
#include "app/turntable_word.h"
#include "core/device/discovery.h"
#include "core/device/port_doctor.h"
#include "core/device/protocol_turntable.h"

namespace gyre {
namespace {

struct Words {
  bool json = false;
  std::string probe;
};

// What answers at the port. Moves nothing.
PortDiagnosis diagnose(const TurntableWord& word, const Task& task) {
  const TurntableOptions options;
  TableSearch search = searchAtPort(word, options.greeting_s, task);
  std::optional<TurntableInfo> info;
  if (search.driver) {
    const auto table = ProtocolTurntable::adopt(std::move(search.driver), options, task);
    if (table) {
      info = (*table)->info();
    } else {
      search.error = table.error();
    }
  }
  return diagnoseSearch(word.port, search, info);
}

int probe(const Words& words, Console& console, const Task& task) {
  const auto word = turntableWord(words.probe);
  if (!word) return console.wrongUse(word.error());
  if (word->port.empty()) {
    return console.wrongUse({Error::Code::kInvalidInput, "A table turned by hand has no port.",
                             "Name a port, such as /dev/ttyUSB0."});
  }
  const PortDiagnosis found = diagnose(*word, task);
  if (task.stopRequested()) return console.fail(cancelled());
  const bool usable = found.state == PortState::kTurntable || found.state == PortState::kHindered ||
                      found.state == PortState::kLocked;
  if (words.json) {
    console.sayAlways(diagnosisJson(found));
    return usable ? kDone : kFailed;
  }
  if (usable) {
    tellDiagnosis(console, found);
    return kDone;
  }
  tellAnswers(console, found.answers);
  return console.fail({Error::Code::kRejected, found.what, found.advice});
}

int run(const Words& words, Console& console, const Task& task) {
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
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
