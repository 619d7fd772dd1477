// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/result_views.h"

#include "core/geometry/turntable_pose.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_file.h"
#include "core/io/file_bytes.h"
#include "core/io/passes_file.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

Result<ResultViews> readOnePass(const fs::path& folder) {
  const auto file = folder / "calibration.json";
  const auto calibration = readCalibration(file);
  if (!calibration) return calibration.error();
  if (!calibration->cam_from_table) {
    return Error{Error::Code::kInvalidInput,
                 "The calibration \"" + file.string() + "\" does not say where the table is.",
                 "Reconstruct with a calibration that was made on the turning table."};
  }
  const auto angles = readAngleList(folder / "angles_solved.csv");
  if (!angles) return angles.error();
  ResultViews views;
  views.reserve(angles->size());
  for (const auto& [picture, angle_rad] : *angles) {
    const Rigid3 pose = camFromTable(*calibration->cam_from_table, angle_rad);
    views.push_back({picture, {calibration->camera, pose}, 0});
  }
  return views;
}

}  // namespace

Result<ResultViews> readResultViews(const fs::path& folder) {
  if (!isThere(folder / kPassesFile)) return readOnePass(folder);
  const auto passes = readPasses(folder / kPassesFile);
  if (!passes) return passes.error();
  ResultViews all;
  for (std::size_t i = 0; i < passes->size(); ++i) {
    const ScanPass& pass = (*passes)[i];
    auto views = readOnePass(folder / pass.name);
    if (!views) return views.error();
    const Rigid3 pass_from_merged = pass.merged_from_pass.inverse();
    for (ResultView& view : *views) {
      view.picture = pass.name + "/" + view.picture;
      view.camera.cam_from_table = view.camera.cam_from_table * pass_from_merged;
      view.pass = i;
      all.push_back(std::move(view));
    }
  }
  return all;
}

bool hasResultViews(const fs::path& folder) {
  if (isThere(folder / kPassesFile)) return true;
  return isThere(folder / "calibration.json") && isThere(folder / "angles_solved.csv");
}

std::vector<PosedCamera> camerasOf(const ResultViews& views) {
  std::vector<PosedCamera> cameras;
  cameras.reserve(views.size());
  for (const ResultView& view : views) cameras.push_back(view.camera);
  return cameras;
}

}  // namespace gyre
