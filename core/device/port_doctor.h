// Tells apart why a turntable cannot be used, and what to do about it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/device/discovery.h"
#include "core/device/find_table.h"
#include "core/device/serial_port.h"
#include "core/scan/device_info.h"
#include "core/scan/port_diagnosis.h"

namespace gyre {

// Where the system tells what it knows. Tests lay out their own.
struct DoctorView {
  DeviceFolders folders;
  std::filesystem::path proc = "/proc";
  std::filesystem::path rules = "/";  // the root under which udev's rules are installed
  // Why the user may not open a device file; nothing when he may.
  std::function<std::optional<Error>(const std::string& path)> hindrance = portError;
};

// "no-permission" and so on, for programs.
std::string_view portStateWord(PortState state);

// Without opening the port: whether it is there, may be opened, and is free.
PortDiagnosis diagnosePort(const std::string& path, const DoctorView& view = {});

// USB adapters of turntable boards that are plugged in and have no port.
std::vector<PortDiagnosis> diagnoseAdapters(const DoctorView& view = {});

// After the port was asked who is there. info: of the turntable, where one was identified.
PortDiagnosis diagnoseSearch(const std::string& port, const TableSearch& search,
                             const std::optional<TurntableInfo>& info, const DoctorView& view = {});

// After the table obeyed and the camera saw no motion (TurningFinder's kRejected).
PortDiagnosis diagnoseMotor(const std::string& port, const Error& nothing_moves);

// The programs that hold the device file open, as far as this user may see: "cura (4711)".
std::vector<std::string> holdersOf(const std::string& path, const DoctorView& view = {});

}  // namespace gyre
