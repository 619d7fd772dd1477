// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/port_doctor.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <system_error>

namespace gyre {
namespace {

namespace fs = std::filesystem;

// The boards of turntables, as packaging/70-gyre.rules names them; "*" stands for any product.
struct KnownAdapter {
  std::string_view vendor;
  std::string_view product;
  std::string_view name;
  std::string_view module;  // of the kernel
};
constexpr std::array kAdapters = {
    KnownAdapter{"1a86", "7523", "CH340", "ch341"},
    KnownAdapter{"1a86", "5523", "CH341", "ch341"},
    KnownAdapter{"1a86", "55d4", "CH9102", "cdc_acm"},
    KnownAdapter{"2341", "*", "Arduino", "cdc_acm"},
    KnownAdapter{"2a03", "*", "Arduino", "cdc_acm"},
    KnownAdapter{"10c4", "ea60", "CP210x", "cp210x"},
    KnownAdapter{"0403", "6001", "FT232R", "ftdi_sio"},
    KnownAdapter{"0403", "6015", "FT231X", "ftdi_sio"},
    KnownAdapter{"0483", "5740", "STM32", "cdc_acm"},
    KnownAdapter{"2e8a", "*", "RP2040", "cdc_acm"},
    KnownAdapter{"303a", "*", "Espressif", "cdc_acm"},
};

std::string firstLine(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

// The numbered folders of running programs.
std::vector<fs::path> programs(const DoctorView& view) {
  std::vector<fs::path> found;
  for (const fs::path& entry : entriesOf(view.proc)) {
    if (isNumber(entry.filename().string())) found.push_back(entry);
  }
  return found;
}

bool runs(std::string_view program, const DoctorView& view) {
  const auto running = programs(view);
  return std::any_of(running.begin(), running.end(),
                     [&](const fs::path& entry) { return firstLine(entry / "comm") == program; });
}

const KnownAdapter* adapterOf(const std::string& vendor, const std::string& product) {
  const auto found = std::find_if(kAdapters.begin(), kAdapters.end(), [&](const auto& known) {
    return known.vendor == vendor && (known.product == "*" || known.product == product);
  });
  return found == kAdapters.end() ? nullptr : &*found;
}

// A USB serial adapter has ttyUSB0 in an interface, a modem tty/ttyACM0.
bool hasPort(const fs::path& usb_device) {
  for (const fs::path& interface : entriesOf(usb_device)) {
    if (interface.filename().string().find(':') == std::string::npos) continue;
    for (const fs::path& part : entriesOf(interface)) {
      const std::string name = part.filename().string();
      if (name.starts_with("ttyUSB") || name == "tty") return true;
    }
  }
  return false;
}

bool ruleInstalled(const DoctorView& view) {
  for (const char* folder : {"etc", "lib", "usr/lib", "usr/local/lib"}) {
    std::error_code failed;
    if (fs::exists(view.rules / folder / "udev/rules.d/70-gyre.rules", failed)) return true;
  }
  return false;
}

PortState stateOf(const TableSearch& search) {
  switch (search.error->code) {
    case Error::Code::kNotFound:
      return PortState::kNoDevice;
    case Error::Code::kNoPermission:
      return PortState::kNoPermission;
    case Error::Code::kBusy:
      // A port that was opened answers; one that is held does not.
      return search.answers.empty() ? PortState::kBusy : PortState::kMoving;
    case Error::Code::kTimeout:
      return PortState::kSilent;
    case Error::Code::kGone:
      return PortState::kGone;
    case Error::Code::kWrongDevice: {
      const bool legible = std::any_of(search.answers.begin(), search.answers.end(),
                                       [](const TableAnswer& answer) { return answer.legible; });
      const bool garbled = !legible && !search.answers.empty();
      return garbled ? PortState::kGarbled : PortState::kUnknownFirmware;
    }
    default:
      return PortState::kFailed;
  }
}

void tellHolder(PortDiagnosis& diagnosis, const DoctorView& view) {
  for (const std::string& holder : holdersOf(diagnosis.port, view)) {
    if (!diagnosis.held_by.empty()) diagnosis.held_by += ", ";
    diagnosis.held_by += holder;
  }
  if (diagnosis.held_by.empty()) return;
  diagnosis.what = diagnosis.port + " is in use by " + diagnosis.held_by + ".";
  diagnosis.advice = "Close that program, then try again.";
}

void tellRule(PortDiagnosis& diagnosis, const DoctorView& view) {
  if (ruleInstalled(view)) return;
  diagnosis.advice +=
      " Or install the rule that comes with Gyre, \"sudo cp packaging/70-gyre.rules "
      "/etc/udev/rules.d/ && sudo udevadm control --reload\", and plug the board in again.";
}

PortDiagnosis grabbed(const std::string& vendor, const std::string& product) {
  PortDiagnosis diagnosis;
  diagnosis.port = vendor + ":" + product;
  diagnosis.state = PortState::kGrabbed;
  diagnosis.what = "The adapter " + diagnosis.port +
                   " is plugged in, and brltty has taken it for a braille display.";
  diagnosis.advice =
      "Tell brltty to leave this adapter alone: \"echo 'SUBSYSTEM==\"usb\", ATTR{idVendor}==\"" +
      vendor + "\", ATTR{idProduct}==\"" + product +
      "\", ENV{SYSTEMD_WANTS}=\"\"' | sudo tee /etc/udev/rules.d/99-gyre-no-brltty.rules && sudo "
      "udevadm control --reload\", then plug it in again. Braille displays on other adapters go on "
      "working.";
  return diagnosis;
}

PortDiagnosis withoutPort(const KnownAdapter& known, const std::string& vendor,
                          const std::string& product) {
  PortDiagnosis diagnosis;
  diagnosis.port = vendor + ":" + product;
  diagnosis.state = PortState::kNoDriver;
  diagnosis.what = "An adapter " + std::string(known.name) + " (" + diagnosis.port +
                   ") is plugged in and has no serial port.";
  diagnosis.advice = "Load its driver with \"sudo modprobe " + std::string(known.module) +
                     "\" and plug it in again; a board in its boot loader has no port either.";
  return diagnosis;
}

}  // namespace

std::string_view portStateWord(PortState state) {
  constexpr std::array<std::string_view, 16> kWords = {
      "ready",   "turntable",     "hindered", "locked", "no-device", "no-driver",
      "grabbed", "no-permission", "busy",     "moving", "garbled",   "unknown-firmware",
      "silent",  "motor-stands",  "gone",     "failed"};
  return kWords.at(static_cast<std::size_t>(state));
}

std::vector<std::string> holdersOf(const std::string& path, const DoctorView& view) {
  std::vector<std::string> holders;
  std::error_code failed;
  const fs::path device = fs::canonical(path, failed);
  if (failed) return holders;
  for (const fs::path& program : programs(view)) {
    for (const fs::path& open : entriesOf(program / "fd")) {
      std::error_code unseen;
      if (fs::read_symlink(open, unseen) != device || unseen) continue;
      std::string holder = firstLine(program / "comm");
      holders.push_back(holder.append(" (").append(program.filename().string()).append(")"));
      break;
    }
  }
  return holders;
}

PortDiagnosis diagnosePort(const std::string& path, const DoctorView& view) {
  PortDiagnosis diagnosis;
  diagnosis.port = path;
  const std::optional<Error> hindrance = view.hindrance(path);
  if (hindrance) {
    TableSearch search;
    search.error = hindrance;
    return diagnoseSearch(path, search, std::nullopt, view);
  }
  if (!holdersOf(path, view).empty()) {
    diagnosis.state = PortState::kBusy;
    tellHolder(diagnosis, view);
    return diagnosis;
  }
  diagnosis.what = path + " is there and may be opened.";
  diagnosis.advice = "Ask who answers: gyre devices --probe " + path;
  return diagnosis;
}

std::vector<PortDiagnosis> diagnoseAdapters(const DoctorView& view) {
  std::vector<PortDiagnosis> found;
  for (const fs::path& device : entriesOf(view.folders.sys / "bus" / "usb" / "devices")) {
    const std::string vendor = firstLine(device / "idVendor");
    const std::string product = firstLine(device / "idProduct");
    const KnownAdapter* known = adapterOf(vendor, product);
    if (known == nullptr || hasPort(device)) continue;
    if (runs("brltty", view) && (known->module == "ch341" || known->module == "cp210x")) {
      found.push_back(grabbed(vendor, product));
      continue;
    }
    found.push_back(withoutPort(*known, vendor, product));
  }
  return found;
}

PortDiagnosis diagnoseSearch(const std::string& port, const TableSearch& search,
                             const std::optional<TurntableInfo>& info, const DoctorView& view) {
  PortDiagnosis diagnosis;
  diagnosis.port = port;
  diagnosis.firmware = search.firmware;
  diagnosis.baud = search.baud;
  diagnosis.answers = search.answers;
  if (search.error) {
    diagnosis.state = stateOf(search);
    diagnosis.what = search.error->what;
    diagnosis.advice = search.error->advice;
    if (diagnosis.state == PortState::kBusy) tellHolder(diagnosis, view);
    if (diagnosis.state == PortState::kNoPermission) tellRule(diagnosis, view);
    return diagnosis;
  }
  diagnosis.state = PortState::kTurntable;
  diagnosis.what = port + " is a turntable.";
  if (!info) return diagnosis;
  diagnosis.firmware = info->firmware;
  diagnosis.steps_per_turn = info->steps_per_turn;
  diagnosis.hindrances = info->hindrances;
  diagnosis.what = port + " is a turntable: " + info->firmware + ".";
  if (!info->hindrances.empty()) {
    diagnosis.state = PortState::kHindered;
    diagnosis.advice = "Nothing was changed; what hinders it follows, with its cure.";
  }
  if (!info->lock.empty()) {
    diagnosis.state = PortState::kLocked;
    diagnosis.advice = info->lock;
  }
  return diagnosis;
}

PortDiagnosis diagnoseMotor(const std::string& port, const Error& nothing_moves) {
  PortDiagnosis diagnosis;
  diagnosis.port = port;
  diagnosis.state = PortState::kMotorStands;
  diagnosis.what = nothing_moves.what;
  diagnosis.advice = nothing_moves.advice;
  return diagnosis;
}

}  // namespace gyre
