// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/device_words.h"

#include "core/base/formatted.h"
#include "core/device/port_doctor.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

std::string field(const char* name, const std::string& value) {
  return std::string("\"") + name + "\": " + jsonString(value);
}

std::string mayOpen(bool may_open) {
  return std::string("\"may_open\": ") + (may_open ? "true" : "false");
}

std::string jsonOf(const ListedPort& port) {
  const PortInfo& info = port.info;
  return "{" + field("path", info.path) + ", " + field("stable_path", info.stable_path) + ", " +
         field("description", info.description) + ", " + field("usb_id", info.usb_id) + ", " +
         mayOpen(info.may_open) + ", " + field("hindrance", info.hindrance) + ", " +
         field("state", std::string(portStateWord(port.diagnosis.state))) + ", " +
         field("held_by", port.diagnosis.held_by) + "}";
}

std::string jsonOf(const PortDiagnosis& adapter) {
  return "{" + field("usb_id", adapter.port) + ", " +
         field("state", std::string(portStateWord(adapter.state))) + ", " +
         field("what", adapter.what) + ", " + field("advice", adapter.advice) + "}";
}

std::string jsonOf(const CameraDeviceInfo& camera) {
  return "{" + field("path", camera.path) + ", " + field("description", camera.description) + ", " +
         mayOpen(camera.may_open) + ", " + field("hindrance", camera.hindrance) + "}";
}

std::string jsonOf(const TableAnswer& answer) {
  return "{\"baud\": " + std::to_string(answer.baud) + ", " + field("asked", answer.asked) + ", " +
         field("heard", answer.heard) + "}";
}

std::string jsonOf(const std::string& sentence) { return jsonString(sentence); }

template <class Entry>
std::string jsonList(const std::vector<Entry>& entries) {
  std::string text = "[";
  for (const Entry& entry : entries) {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + jsonOf(entry);
  }
  return text + (entries.empty() ? "]" : "\n  ]");
}

std::string answerText(const TableAnswer& answer) {
  return "    at " + std::to_string(answer.baud) + " baud, asked " + answer.asked + ": " +
         (answer.heard.empty() ? "no answer" : answer.heard);
}

std::string portText(const PortInfo& port) { return port.path + "  " + port.description; }

}  // namespace

void tellAnswers(Console& console, const std::vector<TableAnswer>& answers) {
  for (const TableAnswer& answer : answers) console.note(answerText(answer));
}

void tellPorts(Console& console, const std::vector<ListedPort>& ports,
               const std::vector<PortDiagnosis>& adapters) {
  if (ports.empty()) console.say("No serial port is connected.");
  for (const ListedPort& port : ports) {
    console.say(portText(port.info));
    if (port.diagnosis.state == PortState::kReady) continue;
    console.say("    " + port.diagnosis.what);
    if (!port.diagnosis.advice.empty()) console.say("    " + port.diagnosis.advice);
  }
  for (const PortDiagnosis& adapter : adapters) tellDiagnosis(console, adapter);
}

void tellCameras(Console& console, const std::vector<CameraDeviceInfo>& cameras) {
  if (cameras.empty()) console.say("No camera is connected.");
  for (const CameraDeviceInfo& camera : cameras) {
    console.say(camera.path + "  " + camera.description);
    if (!camera.hindrance.empty()) console.say("    " + camera.hindrance);
  }
}

void tellDiagnosis(Console& console, const PortDiagnosis& diagnosis) {
  console.say(diagnosis.what);
  if (diagnosis.steps_per_turn > 0.0) {
    const std::string speed =
        diagnosis.baud > 0 ? ", " + std::to_string(diagnosis.baud) + " baud" : "";
    console.say(formatted("    %.6g steps a turn", diagnosis.steps_per_turn) + speed);
  }
  if (!diagnosis.advice.empty()) console.say("    " + diagnosis.advice);
  for (const std::string& hindrance : diagnosis.hindrances) console.say("    " + hindrance);
  tellAnswers(console, diagnosis.answers);
}

std::string devicesJson(const std::vector<ListedPort>& ports,
                        const std::vector<PortDiagnosis>& adapters,
                        const std::vector<CameraDeviceInfo>& cameras) {
  return "{\n  \"ports\": " + jsonList(ports) + ",\n  \"adapters\": " + jsonList(adapters) +
         ",\n  \"cameras\": " + jsonList(cameras) + "\n}";
}

std::string diagnosisJson(const PortDiagnosis& diagnosis) {
  return "{\n  " + field("port", diagnosis.port) + ",\n  " +
         field("state", std::string(portStateWord(diagnosis.state))) + ",\n  " +
         field("what", diagnosis.what) + ",\n  " + field("advice", diagnosis.advice) + ",\n  " +
         field("held_by", diagnosis.held_by) + ",\n  " + field("firmware", diagnosis.firmware) +
         ",\n  \"baud\": " + std::to_string(diagnosis.baud) +
         ",\n  \"steps_per_turn\": " + jsonNumber(diagnosis.steps_per_turn) +
         ",\n  \"hindrances\": " + jsonList(diagnosis.hindrances) +
         ",\n  \"answers\": " + jsonList(diagnosis.answers) + "\n}";
}

}  // namespace gyre
