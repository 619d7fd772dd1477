// Tells whether the words of the command line ask for the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui_words.h"

#include <filesystem>

#include "core/io/model_file.h"

namespace gyre {
namespace {

bool namesModel(const std::string& word) {
  const std::filesystem::path path(word);
  std::error_code ignored;
  const bool openable = path.extension() == ".gyre" || isReadableModel(path) ||
                        std::filesystem::is_directory(path, ignored);
  return openable && std::filesystem::exists(path, ignored);
}

}  // namespace

std::optional<GuiOptions> guiOptions(const std::vector<std::string>& words) {
  GuiOptions options;
  if (words.empty()) return options;
  if (words.size() == 1 && namesModel(words[0])) {
    options.open = words[0];
    return options;
  }
  if (words.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    if (words[i] == "--screenshot") {
      options.screenshot = words[i + 1];
    } else if (words[i] == "--scene") {
      options.scene = words[i + 1];
    } else if (words[i] == "--object") {
      options.object = words[i + 1];
    } else if (words[i] == "--theme") {
      options.theme = words[i + 1];
    } else {
      return std::nullopt;
    }
  }
  if (options.screenshot.empty() || options.scene.empty()) return std::nullopt;
  return options;
}

}  // namespace gyre
