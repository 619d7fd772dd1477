// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/discovery.h"

#include <libserialport.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "core/base/formatted.h"
#include "core/device/serial_port.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

std::string textOr(const char* text, const std::string& otherwise) {
  return text != nullptr && *text != '\0' ? text : otherwise;
}

std::string usbId(const sp_port* port) {
  int vendor = 0;
  int product = 0;
  if (sp_get_port_usb_vid_pid(port, &vendor, &product) != SP_OK) return {};
  return formatted("%04x:%04x", static_cast<unsigned>(vendor) & 0xffffU,
                   static_cast<unsigned>(product) & 0xffffU);
}

std::string firstLine(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

// "video10" after "video9".
bool byNumber(const CameraDeviceInfo& a, const CameraDeviceInfo& b) {
  return a.path.size() != b.path.size() ? a.path.size() < b.path.size() : a.path < b.path;
}

}  // namespace

std::string stablePathOf(const fs::path& port, const DeviceFolders& folders) {
  std::error_code failed;
  const fs::path target = fs::canonical(port, failed);
  if (failed) return {};
  for (const auto& entry : fs::directory_iterator(folders.dev / "serial" / "by-id", failed)) {
    std::error_code broken;
    if (fs::canonical(entry.path(), broken) == target && !broken) return entry.path().string();
  }
  return {};
}

std::vector<PortInfo> listPorts(const DeviceFolders& folders) {
  std::vector<PortInfo> ports;
  sp_port** list = nullptr;
  if (sp_list_ports(&list) != SP_OK) return ports;
  for (sp_port** entry = list; *entry != nullptr; ++entry) {
    PortInfo port;
    port.path = textOr(sp_get_port_name(*entry), "");
    port.description = textOr(sp_get_port_description(*entry), port.path);
    port.usb_id = usbId(*entry);
    port.stable_path = stablePathOf(port.path, folders);
    port.hindrance = portHindrance(port.path);
    port.may_open = port.hindrance.empty();
    ports.push_back(std::move(port));
  }
  sp_free_port_list(list);
  std::sort(ports.begin(), ports.end(),
            [](const PortInfo& a, const PortInfo& b) { return a.path < b.path; });
  return ports;
}

std::vector<CameraDeviceInfo> listCameras(const DeviceFolders& folders) {
  std::vector<CameraDeviceInfo> cameras;
  std::error_code failed;
  const fs::path known = folders.sys / "class" / "video4linux";
  for (const auto& entry : fs::directory_iterator(known, failed)) {
    const std::string node = entry.path().filename().string();
    const std::string index = firstLine(entry.path() / "index");
    if (!node.starts_with("video") || (!index.empty() && index != "0")) continue;
    CameraDeviceInfo camera;
    camera.path = (folders.dev / node).string();
    const std::string name = firstLine(entry.path() / "name");
    camera.description = name.empty() ? node : name;
    camera.hindrance = portHindrance(camera.path);
    camera.may_open = camera.hindrance.empty();
    cameras.push_back(std::move(camera));
  }
  std::sort(cameras.begin(), cameras.end(), byNumber);
  return cameras;
}

}  // namespace gyre
