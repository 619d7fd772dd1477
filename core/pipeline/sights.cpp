// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/sights.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "core/geometry/turntable_pose.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_file.h"
#include "core/io/silhouettes_file.h"

namespace gyre {

namespace {

// So many views, spread over the turn, tell where the background is seen: a wrong outline in one
// does no harm, and more of them tell little that is new.
constexpr std::size_t kOutlinesAsked = 72;
constexpr int kStride_px = 2;  // in the outline
constexpr int kMargin_px = 3;  // around the outline's box: rays farther out meet nothing anyhow

void addBackground(const Silhouette& silhouette, const CameraModel& camera,
                   const Rigid3& cam_from_table, std::vector<Ray>& rays) {
  const cv::Mat& mask = silhouette.mask;
  const double shrunk = static_cast<double>(camera.width_px) / mask.cols;
  int left = mask.cols;
  int right = -1;
  int top = mask.rows;
  int bottom = -1;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = y;
    }
  }
  for (int y = std::max(0, top - kMargin_px); y < std::min(mask.rows, bottom + kMargin_px);
       y += kStride_px) {
    for (int x = std::max(0, left - kMargin_px); x < std::min(mask.cols, right + kMargin_px);
         x += kStride_px) {
      if (mask.at<std::uint8_t>(y, x) != 0) continue;
      const Eigen::Vector2d pixel((x + 0.5) * shrunk - 0.5, (y + 0.5) * shrunk - 0.5);
      rays.push_back(rayThrough(cam_from_table, camera.normalizedFromPixel(pixel)));
    }
  }
}

}  // namespace

SightEvidence sightsOf(const Calibration& calibration, std::span<const double> table_angles_rad,
                       const Silhouettes& silhouettes) {
  SightEvidence sights;
  std::vector<Rigid3> poses;
  for (const double angle_rad : table_angles_rad) {
    poses.push_back(camFromTable(*calibration.cam_from_table, angle_rad));
    sights.camera_centres.push_back(poses.back().inverse().translation);
  }
  const std::size_t asked = std::min(kOutlinesAsked, silhouettes.size());
  for (std::size_t i = 0; i < asked; ++i) {
    const Silhouette& silhouette = silhouettes[i * silhouettes.size() / asked];
    if (silhouette.view >= poses.size()) continue;
    addBackground(silhouette, calibration.camera, poses[silhouette.view], sights.background);
  }
  return sights;
}

Result<std::optional<SightEvidence>> readSights(const std::filesystem::path& folder) {
  const auto calibration_file = folder / "calibration.json";
  const auto angles_file = folder / "angles_solved.csv";
  std::error_code ignored;
  if (!std::filesystem::exists(calibration_file, ignored) ||
      !std::filesystem::exists(angles_file, ignored)) {
    return std::optional<SightEvidence>();
  }
  const auto calibration = readCalibration(calibration_file);
  if (!calibration) return calibration.error();
  if (!calibration->cam_from_table) {
    return Error{Error::Code::kInvalidInput,
                 "The calibration \"" + calibration_file.string() +
                     "\" does not say where the table is.",
                 "Reconstruct with a calibration that was made on the turning table."};
  }
  const auto angles = readAngleList(angles_file);
  if (!angles) return angles.error();
  std::vector<double> angles_rad;
  for (const PictureAngle& each : *angles) angles_rad.push_back(each.angle_rad);
  Silhouettes silhouettes;
  if (const auto file = folder / "silhouettes.bin"; std::filesystem::exists(file, ignored)) {
    auto read = readSilhouettes(file);
    if (!read) return read.error();
    silhouettes = std::move(*read);
  }
  return std::optional(sightsOf(*calibration, angles_rad, silhouettes));
}

}  // namespace gyre
