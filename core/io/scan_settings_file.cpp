// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_settings_file.h"

#include <cmath>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/address.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

using nlohmann::ordered_json;

constexpr std::uintmax_t kMaxBytes = 16U << 20U;
constexpr double kMaxAngle_rad = 1e5;

Error badSettings(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The scan file \"" + file + "\" " + problem + ".",
          "Give the .gyre file that the program wrote; the pictures in \"frames\" are untouched."};
}

// The text under the key; none when there is no such key.
std::string textAt(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

ordered_json controlsJson(const std::vector<ControlState>& controls) {
  ordered_json list = ordered_json::array();
  for (const ControlState& control : controls) {
    ordered_json entry;
    entry["name"] = control.name;
    entry["locked"] = control.locked;
    entry["value"] = control.value;
    if (!control.word.empty()) entry["word"] = control.word;
    if (!control.remark.empty()) entry["remark"] = control.remark;
    list.push_back(std::move(entry));
  }
  return list;
}

// What is no control is passed over.
std::vector<ControlState> controlsIn(const ordered_json& list) {
  std::vector<ControlState> controls;
  if (!list.is_array()) return controls;
  for (const ordered_json& entry : list) {
    if (!entry.is_object()) continue;
    const ordered_json value = entry.value("value", ordered_json());
    ControlState control{textAt(entry, "name"), entry.value("locked", ordered_json()) == true,
                         value.is_number() ? value.get<double>() : 0.0, textAt(entry, "remark"),
                         textAt(entry, "word")};
    if (!control.name.empty()) controls.push_back(std::move(control));
  }
  return controls;
}

}  // namespace

Result<ScanSettings> parseScanSettings(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const ordered_json root = ordered_json::parse(text);
  if (!root.is_object() || textAt(root, "format") != "gyre-scan") {
    return badSettings(file, "is no scan of Gyre: its \"format\" is not \"gyre-scan\"");
  }
  if (root.value("version", ordered_json()) != 1) {
    return badSettings(file, "is of a version that this program does not know");
  }
  ScanSettings settings;
  settings.title = textAt(root, "title");
  settings.inventory_number = textAt(root, "inventory_number");
  settings.rights = textAt(root, "rights");
  settings.turntable = textAt(root, "turntable");
  settings.camera = textAt(root, "camera");
  settings.camera_mode = textAt(root, "camera_mode");
  settings.camera_controls = controlsIn(root.value("camera_controls", ordered_json()));
  if (root.contains("axis")) settings.axis = textAt(root, "axis");
  // Scans of older versions have neither, and turned as the firmware counts degrees.
  const ordered_json units = root.value("units_per_turn", ordered_json(360.0));
  if (!units.is_number() || !(units.get<double>() > 0.0)) {
    return badSettings(file, "has no usable \"units_per_turn\"");
  }
  settings.units_per_turn = units.get<double>();
  settings.direction = root.value("direction", ordered_json(1)) == -1 ? -1 : 1;
  const ordered_json rig = root.value("sim_rig", ordered_json());
  if (!rig.is_null()) settings.sim_rig_json = rig.dump();
  const ordered_json views = root.value("views", ordered_json());
  if (!views.is_number_integer() || views < 1 || views > kMaxViews) {
    return badSettings(file, "has no usable number of \"views\"");
  }
  settings.views = views.get<int>();
  const ordered_json angle = root.value("start_angle_rad", ordered_json());
  if (!angle.is_number() || std::abs(angle.get<double>()) > kMaxAngle_rad) {
    return badSettings(file, "has no usable \"start_angle_rad\"");
  }
  settings.start_angle_rad = angle.get<double>();
  return settings;
}

Result<ScanSettings> readScanSettings(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseScanSettings(*text, file.string());
}

Result<std::string> scanSettingsText(const ScanSettings& settings) {
  const std::string& rig = settings.sim_rig_json;
  if (const auto valid = checkJson(rig.empty() ? "null" : rig, "rig.json"); !valid) {
    return valid.error();
  }
  ordered_json root;
  root["format"] = "gyre-scan";
  root["version"] = 1;
  root["title"] = settings.title;
  root["inventory_number"] = settings.inventory_number;
  root["rights"] = settings.rights;
  root["turntable"] = settings.turntable;
  root["camera"] = withoutPassword(settings.camera);
  root["camera_mode"] = settings.camera_mode;
  root["camera_controls"] = controlsJson(settings.camera_controls);
  root["axis"] = settings.axis;
  root["units_per_turn"] = settings.units_per_turn;
  root["direction"] = settings.direction;
  root["views"] = settings.views;
  root["start_angle_rad"] = settings.start_angle_rad;
  if (!rig.empty()) root["sim_rig"] = ordered_json::parse(rig);
  std::string text = root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  if (const auto readable = parseScanSettings(text, "scan.gyre"); !readable) {
    return readable.error();
  }
  return text;
}

Result<std::filesystem::path> scanSettingsFileIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code problem;
  for (std::filesystem::directory_iterator entry(folder, problem);
       !problem && entry != std::filesystem::directory_iterator(); entry.increment(problem)) {
    const std::filesystem::path& file = entry->path();
    if (file.extension() != ".gyre" || file.filename().string().starts_with('.')) continue;
    if (file.stem() == folder.filename()) return file;
    found.push_back(file);
  }
  if (problem) return fileError(problem.value(), "open", folder);
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    return Error{Error::Code::kInvalidInput,
                 "There are several .gyre files in \"" + folder.string() + "\".",
                 "Give the one to open."};
  }
  return Error{Error::Code::kNotFound, "There is no scan in \"" + folder.string() + "\".",
               "Give a folder that holds a .gyre file."};
}

}  // namespace gyre
