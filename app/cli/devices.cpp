// gyre devices: ports and cameras, listed without opening any.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "app/rig.h"
#include "core/device/discovery.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

struct Words {
  bool json = false;
  std::string probe;
};

std::string field(const char* name, const std::string& value) {
  return std::string("\"") + name + "\": " + jsonString(value);
}

std::string mayOpen(bool may_open) {
  return std::string("\"may_open\": ") + (may_open ? "true" : "false");
}

std::string jsonOf(const PortInfo& port) {
  return "{" + field("path", port.path) + ", " + field("stable_path", port.stable_path) + ", " +
         field("description", port.description) + ", " + field("usb_id", port.usb_id) + ", " +
         mayOpen(port.may_open) + ", " + field("hindrance", port.hindrance) + "}";
}

std::string jsonOf(const CameraDeviceInfo& camera) {
  return "{" + field("path", camera.path) + ", " + field("description", camera.description) + ", " +
         mayOpen(camera.may_open) + ", " + field("hindrance", camera.hindrance) + "}";
}

template <class Device>
std::string jsonList(const std::vector<Device>& devices) {
  std::string text = "[";
  for (const Device& device : devices) {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + jsonOf(device);
  }
  return text + (devices.empty() ? "]" : "\n  ]");
}

template <class Device>
void tell(Console& console, const std::string& kind, const std::vector<Device>& devices) {
  if (devices.empty()) console.say("No " + kind + " is connected.");
  for (const Device& device : devices) {
    console.say(device.path + "  " + device.description);
    if (!device.hindrance.empty()) console.say("    " + device.hindrance);
  }
}

// Says what answers at the port. Moves nothing.
int probe(const std::string& port, Console& console, const Task& task) {
  const RigOptions options;
  const auto turntable = openTurntable(port, options, nullptr, task);
  if (!turntable) return console.fail(turntable.error());
  const TurntableInfo info = (*turntable)->info();
  console.say(port + "  " + info.firmware + ", " +
              std::to_string(static_cast<long>(info.steps_per_turn)) + " steps a turn");
  for (const std::string& hindrance : info.hindrances) console.say("    " + hindrance);
  return kDone;
}

int run(const Words& words, Console& console, const Task& task) {
  if (!words.probe.empty()) return probe(words.probe, console, task);
  const auto ports = listPorts();
  const auto cameras = listCameras();
  if (words.json) {
    console.sayAlways("{\n  \"ports\": " + jsonList(ports) +
                      ",\n  \"cameras\": " + jsonList(cameras) + "\n}");
    return kDone;
  }
  tell(console, "serial port", ports);
  tell(console, "camera", cameras);
  console.say("Always there: the simulated rig, as --turntable sim --camera sim.");
  return kDone;
}

}  // namespace

void addDevices(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("devices", "List ports and cameras without opening them");
  auto* json = command->add_flag("--json", words->json, "As JSON");
  command->add_option("--probe", words->probe, "Identify the turntable at this port; moves nothing")
      ->excludes(json)
      ->check([](const std::string& port) {
        return namesSimulation(port) ? "sim is always there; name a port" : "";
      });
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
