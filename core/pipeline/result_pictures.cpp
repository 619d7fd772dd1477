// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/result_pictures.h"

#include <system_error>

#include "core/io/angles_file.h"
#include "core/io/report_reader.h"

namespace gyre {

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

fs::path findPicture(const std::vector<fs::path>& folders, const std::string& name) {
  std::error_code ignored;
  for (const fs::path& folder : folders) {
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  }
  return {};
}

fs::path firstPictureOf(const fs::path& folder) {
  const auto angles = readAngleList(folder / "angles_solved.csv");
  if (!angles || angles->empty()) return {};
  return findPicture(pictureFoldersOf(folder), angles->front().picture);
}

}  // namespace gyre
