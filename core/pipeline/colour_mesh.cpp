// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/colour_mesh.h"

#include <utility>
#include <vector>

#include "core/geometry/turntable_pose.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_file.h"
#include "core/io/picture_file.h"
#include "core/mesh/vertex_colours.h"

namespace gyre {

Result<std::size_t> colourFromPictures(Mesh& mesh, const std::filesystem::path& folder,
                                       const std::filesystem::path& pictures, const Task& task) {
  const auto calibration = readCalibration(folder / "calibration.json");
  if (!calibration) return calibration.error();
  if (!calibration->cam_from_table) {
    return Error{Error::Code::kInvalidInput,
                 "The calibration in \"" + folder.string() + "\" does not say where the table is.",
                 "Reconstruct with a calibration that was made on the turning table."};
  }
  const auto angles = readAngleList(folder / "angles_solved.csv");
  if (!angles) return angles.error();
  std::vector<Rigid3> cam_from_table;
  for (const PictureAngle& each : *angles) {
    cam_from_table.push_back(camFromTable(*calibration->cam_from_table, each.angle_rad));
  }
  const auto picture_of = [&](std::size_t view) -> Result<cv::Mat> {
    auto frame = readPicture(pictures / (*angles)[view].picture);
    if (!frame) return frame.error();
    return std::move(frame->image_bgr);
  };
  return colourVertices(mesh, calibration->camera, cam_from_table, picture_of, task);
}

}  // namespace gyre
