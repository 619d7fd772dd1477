// gyre sim-firmware: a simulated turntable on a loopback port, for other programs to talk to.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "core/sim/firmware_boards.h"
#include "core/sim/firmware_server.h"
#include "core/sim/shaft.h"
#include "core/sim/sim_clock.h"

namespace gyre {
namespace {

struct Words {
  int tcp_port = 0;
  double speed = 1.0;
  std::string firmware = "grbl";
};

int run(const Words& words, Console& console, const Task& task) {
  const auto firmware = std::make_shared<TurntableFirmware>(
      makeFirmwareBoard(words.firmware, TurntableFirmwareOptions{}, std::make_shared<Shaft>()),
      SimClock(words.speed));
  const auto server = FirmwareServer::start(firmware, words.tcp_port);
  if (!server) return console.fail(server.error());
  console.say("The simulated turntable (" + words.firmware + ") listens on tcp:127.0.0.1:" +
              std::to_string((*server)->port()) + "; Ctrl-C ends it.");
  while (task.sleepFor(60.0)) {
  }
  return kStopped;
}

}  // namespace

void addSimFirmware(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("sim-firmware", "Serve a simulated turntable on a loopback TCP port");
  command->add_option("--tcp", words->tcp_port, "Port on 127.0.0.1; 0 lets the system choose")
      ->required()
      ->check(CLI::Range(0, 65535));
  command->add_option("--firmware", words->firmware, "What is on its board (default grbl)")
      ->check(CLI::IsMember(firmwareBoardNames()));
  command->add_option("--sim-speed", words->speed, "Simulated seconds a second (default 1)")
      ->check(CLI::Range(0.1, 1000.0));
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
