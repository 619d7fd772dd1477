// Pictures of a model, as the camera would see it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/frame.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// The surface in one colour, lit from over the camera's left shoulder; what is seen from within is
// dark red. 8 bit BGR, the camera's size, white where there is nothing. Any thread.
cv::Mat pictureOfSurface(const Mesh& mesh, const CameraModel& camera, const Rigid3& cam_from_table);

// The points that face the camera, as dots in their colours, the nearer over the farther.
cv::Mat pictureOfPoints(const PointCloud& cloud, const CameraModel& camera,
                        const Rigid3& cam_from_table);

}  // namespace gyre
