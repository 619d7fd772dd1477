// Lists ports and cameras by name without opening any.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scan/device_info.h"

namespace gyre {

// Where the system keeps its device files and what it knows of them. Tests lay out their own.
struct DeviceFolders {
  std::filesystem::path dev = "/dev";
  std::filesystem::path sys = "/sys";
};

// Serial ports that have hardware behind them, by libserialport (from /sys), in order of path.
std::vector<PortInfo> listPorts(const DeviceFolders& folders = {});

// Video devices that give pictures (a camera's second node, for its metadata, is left out).
std::vector<CameraDeviceInfo> listCameras(const DeviceFolders& folders = {});

// The name under /dev/serial/by-id that stays the same at whatever socket, or empty.
std::string stablePathOf(const std::filesystem::path& port, const DeviceFolders& folders = {});

}  // namespace gyre
