// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/formatted.h"
#include "core/io/camera_export.h"
#include "core/io/posed_pictures.h"

namespace gyre {
namespace {

using nlohmann::ordered_json;

constexpr double kMostSkew_px = 0.1;  // that may be left out
constexpr double kCubeShare = 0.8;    // of Instant-NGP's cube that the object fills

ordered_json matrixJson(const Rigid3& cam_from_table) {
  const Rigid3 table_from_cam = cam_from_table.inverse();
  Eigen::Matrix4d table_from_opengl = Eigen::Matrix4d::Identity();
  table_from_opengl.topLeftCorner<3, 3>() =
      table_from_cam.rotation * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  table_from_opengl.topRightCorner<3, 1>() = table_from_cam.translation;
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    ordered_json entries = ordered_json::array();
    for (int column = 0; column < 4; ++column) entries.push_back(table_from_opengl(row, column));
    rows.push_back(std::move(entries));
  }
  return rows;
}

void addCamera(const CameraModel& camera, ordered_json& root) {
  root["camera_model"] = "OPENCV";
  root["camera_angle_x"] = 2.0 * std::atan(0.5 * camera.width_px / camera.fx);
  root["camera_angle_y"] = 2.0 * std::atan(0.5 * camera.height_px / camera.fy);
  root["w"] = camera.width_px;
  root["h"] = camera.height_px;
  root["fl_x"] = camera.fx;
  root["fl_y"] = camera.fy;
  root["cx"] = camera.cx + kPixelCentre;
  root["cy"] = camera.cy + kPixelCentre;
  root["k1"] = camera.k1;
  root["k2"] = camera.k2;
  root["p1"] = camera.p1;
  root["p2"] = camera.p2;
  if (camera.k3 != 0.0) root["k3"] = camera.k3;
}

// Instant-NGP takes scale * position + offset, and wants what it sees in [0, 1].
void addCube(const PointCloud& cloud, ordered_json& root) {
  const Bounds bounds = boundsOf(cloud);
  if (!(bounds.diagonal() > 0.0)) return;
  const double scale = kCubeShare / (bounds.max - bounds.min).maxCoeff();
  const Eigen::Vector3d offset =
      Eigen::Vector3d::Constant(0.5) - 0.5 * scale * (bounds.min + bounds.max);
  root["aabb_scale"] = 1;
  root["scale"] = scale;
  root["offset"] = {offset.x(), offset.y(), offset.z()};
}

}  // namespace

Result<void> checkSkew(const CameraModel& camera) {
  const double shift_px = std::abs(camera.skew) * 0.5 * camera.height_px / camera.fy;
  if (shift_px <= kMostSkew_px) return {};
  return Error{Error::Code::kInvalidInput,
               formatted("The camera has a skew that moves pixels by up to %.2f px, which other "
                         "programs cannot take.",
                         shift_px),
               "Calibrate without a skew, and reconstruct again."};
}

Result<std::string> transformsText(const PosedPictures& posed) {
  for (const CameraModel& camera : posed.cameras) {
    if (const auto fits = checkSkew(camera); !fits) return fits.error();
  }
  ordered_json root;
  root["comment"] =
      "Written by Gyre. Positions are millimetres in the turntable's frame: z up along the axis, "
      "the "
      "object at rest, the cameras around it. transform_matrix: from x right, y up, z backwards.";
  root["unit"] = "mm";
  if (!posed.cameras.empty()) addCamera(posed.cameras.front(), root);
  addCube(posed.cloud, root);
  root["frames"] = ordered_json::array();
  for (const PosedPicture& picture : posed.pictures) {
    ordered_json frame;
    frame["file_path"] = "images/" + picture.name;
    if (!picture.mask.empty()) frame["mask_path"] = "masks/" + picture.mask;
    if (posed.cameras.size() > 1) addCamera(posed.cameras[picture.camera], frame);
    frame["transform_matrix"] = matrixJson(picture.cam_from_table);
    root["frames"].push_back(std::move(frame));
  }
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gyre
