// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/result_views.h"

#include <utility>

#include "core/geometry/turntable_pose.h"
#include "core/io/calibration_file.h"

namespace gyre {

std::vector<Rigid3> ResultViews::camFromTable() const {
  std::vector<Rigid3> poses;
  poses.reserve(angles.size());
  for (const PictureAngle& each : angles) {
    poses.push_back(gyre::camFromTable(*calibration.cam_from_table, each.angle_rad));
  }
  return poses;
}

Result<ResultViews> readResultViews(const std::filesystem::path& folder) {
  const auto file = folder / "calibration.json";
  auto calibration = readCalibration(file);
  if (!calibration) return calibration.error();
  if (!calibration->cam_from_table) {
    return Error{Error::Code::kInvalidInput,
                 "The calibration \"" + file.string() + "\" does not say where the table is.",
                 "Reconstruct with a calibration that was made on the turning table."};
  }
  auto angles = readAngleList(folder / "angles_solved.csv");
  if (!angles) return angles.error();
  return ResultViews{std::move(*calibration), std::move(*angles)};
}

}  // namespace gyre
