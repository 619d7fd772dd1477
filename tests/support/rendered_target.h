// Pictures of calibration targets whose corners are known exactly.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/frame.h"
#include "core/scan/target.h"

namespace gyre::test {

// How the picture is taken.
struct TargetScene {
  double dark = 40.0;            // grey levels
  double bright = 200.0;         // grey levels
  double ground = 110.0;         // of what is around the target
  double psf_px = 0.8;           // scale of the lens' Gaussian blur
  double noise = 0.0;            // standard deviation, grey levels
  double shade = 0.0;            // 0.5: light falls to half from left to right
  double cloth_square_mm = 0.0;  // above 0: the target stands on an endless checkered cloth
  std::uint64_t seed = 1;        // of the noise
};

// CV_8UC3. Corners and codes are drawn as the target says, by 4 x 4 samples a pixel; faces hide
// what is behind them. The squares of a board reach one beyond its outer corners.
cv::Mat renderTarget(const Target& target, const CameraModel& camera, const Rigid3& cam_from_target,
                     const TargetScene& scene = {});

// A camera of this size without distortion that shows about 40 degrees across.
CameraModel plainCamera(int width_px, int height_px);

// Above the table at this distance from the target's origin and elevation, looking at a point above
// the origin; the table turned by the angle.
Rigid3 lookAtTarget(double distance_mm, double elevation_rad, double table_angle_rad,
                    double aim_height_mm = 15.0);

// Where the picture truly shows a point of the target; nothing when it is behind the camera.
std::optional<Eigen::Vector2d> truePixel(const Target& target, const CameraModel& camera,
                                         const Rigid3& cam_from_target, int point);

// Writes the picture with the sightings drawn on it where GYRE_TEST_OVERLAYS names a folder.
struct Overlay {
  std::vector<Eigen::Vector2d> points;
  std::vector<int> groups;  // a colour each; empty for one
};
void saveOverlay(const cv::Mat& image, const Overlay& overlay, const std::string& name);

}  // namespace gyre::test
