// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_label.h"

#include <algorithm>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "core/io/json_text.h"
#include "core/io/scan_settings_file.h"

namespace gyre {
namespace {

std::string writableText(std::string_view text) {
  // Writing and reading once as JSON replaces the bytes that are not UTF-8.
  std::string valid = nlohmann::json::parse(jsonString(text)).get<std::string>();
  std::replace_if(
      valid.begin(), valid.end(), [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; },
      ' ');
  return valid;
}

}  // namespace

ModelLabel labelOfScan(const std::filesystem::path& path) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(path, ignored);
  std::filesystem::path file = path;
  if (path.extension() != ".gyre") {
    // A file's folder may be the one that the program was started in.
    const auto folder = std::filesystem::absolute(is_folder ? path : path.parent_path(), ignored);
    const auto found = scanSettingsFileIn(folder);
    if (!found) return {};
    file = *found;
  }
  const auto settings = readScanSettings(file);
  if (!settings) return {};
  return {settings->title, settings->inventory_number, settings->rights};
}

ModelLabel writableLabel(const ModelLabel& label) {
  return {writableText(label.title), writableText(label.inventory_number),
          writableText(label.rights)};
}

}  // namespace gyre
