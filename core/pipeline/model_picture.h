// Pictures of a model, as a camera would see it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/posed_camera.h"
#include "core/scan/frame.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

enum class SurfacePaint : std::uint8_t {
  kClay,     // one colour; what is seen from within is dark red
  kColours,  // the vertices' own; hatched where no camera saw the surface
  kFigures,  // the vertices' own, which stand for numbers: little shading, from within as well
};

// A square picture that holds all of the box, z up, from ten times its radius; boxes of one size
// have one scale from every azimuth. Azimuth 0 looks from +x, where a scan's camera stands at table
// angle 0; 90 degrees from +y.
PosedCamera viewOf(const Bounds& bounds, double azimuth_rad, double elevation_rad, int size_px);

// The surface, lit from over the camera's left shoulder. 8 bit BGR, the camera's size, white where
// there is nothing. Any thread.
cv::Mat pictureOfSurface(const Mesh& mesh, const CameraModel& camera, const Rigid3& cam_from_table);

// The same from several sides.
std::vector<cv::Mat> picturesOfSurface(const Mesh& mesh, std::span<const PosedCamera> views,
                                       SurfacePaint paint);

// The points that face the camera, as dots in their colours, the nearer over the farther. Points
// without a normal face every camera.
cv::Mat pictureOfPoints(const PointCloud& cloud, const CameraModel& camera,
                        const Rigid3& cam_from_table);

}  // namespace gyre
