// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/result_pictures.h"

#include <system_error>

#include "core/io/angles_file.h"
#include "core/io/file_bytes.h"
#include "core/io/passes_file.h"
#include "core/io/report_reader.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pictureFoldersOf(const fs::path& folder) {
  std::vector<fs::path> folders = {folder / "frames"};
  const auto report = readReport(folder / "report.json");
  if (!report) return folders;
  const auto told = report->inputs.find("pictures");
  if (told == report->inputs.end()) return folders;
  fs::path pictures = told->second;
  if (pictures.extension() == ".gyre") pictures = pictures.parent_path();
  folders.push_back(pictures / "frames");
  folders.push_back(pictures);
  return folders;
}

}  // namespace

PictureFinder::PictureFinder(const fs::path& result_folder, const fs::path& named) {
  if (!named.empty()) {
    places_.push_back({"", {named}});
    return;
  }
  if (isThere(result_folder / kPassesFile)) {
    const auto passes = readPasses(result_folder / kPassesFile);
    if (!passes) return;
    for (const ScanPass& pass : *passes) {
      places_.push_back({pass.name + "/", pictureFoldersOf(pass.folder)});
    }
    return;
  }
  places_.push_back({"", pictureFoldersOf(result_folder)});
}

fs::path PictureFinder::find(const std::string& picture) const {
  std::error_code ignored;
  for (const Place& place : places_) {
    if (!picture.starts_with(place.before)) continue;
    const std::string name = picture.substr(place.before.size());
    for (const fs::path& folder : place.folders) {
      if (fs::is_regular_file(folder / name, ignored)) return folder / name;
    }
  }
  return {};
}

fs::path firstPictureOf(const fs::path& folder) {
  std::string pass;
  if (isThere(folder / kPassesFile)) {
    const auto passes = readPasses(folder / kPassesFile);
    if (!passes) return {};
    pass = passes->front().name + "/";
  }
  const auto angles = readAngleList(folder / pass / "angles_solved.csv");
  if (!angles || angles->empty()) return {};
  return PictureFinder(folder).find(pass + angles->front().picture);
}

}  // namespace gyre
