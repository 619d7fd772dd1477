// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bundle.h"

#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/device_words.h"
#include "app/kept_wire_log.h"
#include "app/table_at_port.h"
#include "app/turntable_word.h"
#include "app/version.h"
#include "core/device/port_doctor.h"
#include "core/io/archive_file.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostSettings_bytes = 1U << 20U;

struct Item {
  std::string name;  // in the archive
  fs::path file;
  bool picture = false;
};

bool tellsWithoutShowing(const fs::path& file) {
  const std::string name = file.filename().string();
  const auto ends = [&](const char* ending) { return name.ends_with(ending); };
  return ends(".gyre") || ends(".json") || ends(".jsonl") || ends(".csv") || ends(".log") ||
         ends(".log.1");
}

bool isPicture(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

// The scan's own files; its pictures and points when they are wished for.
std::vector<Item> itemsOf(const fs::path& folder, const std::string& title,
                          BundlePictures pictures) {
  std::vector<Item> items;
  std::error_code failed;
  const bool whole = pictures == BundlePictures::kInclude;
  for (auto entry = fs::recursive_directory_iterator(folder, failed);
       !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    std::error_code unread;
    if (!entry->is_regular_file(unread) || unread) continue;
    const fs::path& file = entry->path();
    if (!tellsWithoutShowing(file) && !(whole && (isPicture(file) || file.extension() == ".ply"))) {
      continue;
    }
    const fs::path name = fs::path(title) / file.lexically_relative(folder);
    items.push_back({name.generic_string(), file, isPicture(file)});
  }
  std::sort(items.begin(), items.end(),
            [](const Item& a, const Item& b) { return a.name < b.name; });
  return items;
}

// The port that the scan's settings name, as far as they can be read.
std::string portOf(const std::vector<Item>& items) {
  for (const Item& item : items) {
    if (item.file.extension() != ".gyre") continue;
    const auto text = readFileBytes(item.file, kMostSettings_bytes);
    if (!text) continue;
    const auto settings = nlohmann::json::parse(*text, nullptr, false);
    if (!settings.is_object() || !settings.contains("turntable")) continue;
    const auto& turntable = settings.at("turntable");
    if (!turntable.is_string()) continue;
    const auto word = turntableWord(turntable.get<std::string>());
    if (word) return word->port;
  }
  return {};
}

bool holdsWireLog(const std::vector<Item>& items, const std::string& title) {
  return std::any_of(items.begin(), items.end(),
                     [&](const Item& item) { return item.name == title + "/" + kKeptWireLog; });
}

// Of a scan that was cut off before its log was copied: what lies in the user's cache.
void addWireLogs(const std::string& port, const std::string& title, std::vector<Item>& items) {
  if (port.empty()) return;
  const fs::path log = wireLogFile(port);
  for (const char* ending : {"", ".1"}) {
    std::error_code failed;
    const fs::path file = log.string() + ending;
    if (fs::is_regular_file(file, failed)) {
      items.push_back({title + "/wire/" + file.filename().string(), file});
    }
  }
}

std::string systemName() {
  std::ifstream stream("/etc/os-release");
  std::string line;
  const std::string key = "PRETTY_NAME=";
  while (std::getline(stream, line)) {
    if (!line.starts_with(key)) continue;
    line = line.substr(key.size());
    std::erase(line, '"');
    return line;
  }
  return {};
}

std::string versionsJson() {
  utsname kernel{};
  uname(&kernel);
  return "{\n  \"gyre\": " + jsonString(programVersion()) +
         ",\n  \"system\": " + jsonString(systemName()) +
         ",\n  \"kernel\": " + jsonString(std::string(kernel.sysname) + " " + kernel.release) +
         ",\n  \"machine\": " + jsonString(kernel.machine) + "\n}\n";
}

std::string presentDevicesJson() {
  std::vector<ListedPort> ports;
  for (const PortInfo& port : listPorts()) ports.push_back({port, diagnosePort(port.path)});
  return devicesJson(ports, diagnoseAdapters(), listCameras()) + "\n";
}

Result<fs::path> folderOf(const fs::path& scan) {
  std::error_code failed;
  const fs::path folder = fs::is_regular_file(scan, failed) ? scan.parent_path() : scan;
  if (fs::is_directory(folder, failed)) return fs::weakly_canonical(folder, failed);
  return Error{Error::Code::kNotFound, "There is no scan at \"" + scan.string() + "\".",
               "Give the scan's folder, or the .gyre file in it."};
}

}  // namespace

Result<Bundled> writeBundle(const fs::path& scan, const fs::path& out, BundlePictures pictures,
                            const Task& task) {
  const auto folder = folderOf(scan);
  if (!folder) return folder.error();
  const std::string title = folder->filename().string();
  std::vector<Item> items = itemsOf(*folder, title, pictures);
  if (items.empty()) {
    return Error{Error::Code::kNotFound, "\"" + folder->string() + "\" holds nothing of a scan.",
                 "Give the scan's folder, or the .gyre file in it."};
  }
  if (!holdsWireLog(items, title)) addWireLogs(portOf(items), title, items);
  auto archive = ArchiveFile::create(out);
  if (!archive) return archive.error();
  for (const auto& [name, text] : {std::pair(title + "/versions.json", versionsJson()),
                                   std::pair(title + "/devices.json", presentDevicesJson())}) {
    if (const auto added = archive->add(name, text); !added) return added.error();
  }
  Bundled bundled;
  bundled.files = 2;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(items.size()), "Packing");
    const auto added = archive->addFile(items[i].name, items[i].file);
    if (!added) return added.error();
    ++bundled.files;
    if (items[i].picture) ++bundled.pictures;
  }
  if (const auto finished = archive->finish(); !finished) return finished.error();
  return bundled;
}

}  // namespace gyre
