// How far away a mesh is behind each pixel of a camera.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/posed_camera.h"
#include "core/scan/frame.h"
#include "core/scan/mesh.h"

namespace gyre {

// Along the camera's axis, in mm, of the nearest surface at each pixel of a picture smaller by the
// factor; infinite where there is none. 32 bit floats. Triangles with a corner that the camera
// cannot see are left out; lens distortion bends corners, not edges, which is nothing for triangles
// of a scan. Thread: any.
cv::Mat depthMap(const Mesh& mesh, const PosedCamera& camera, int shrink);

}  // namespace gyre
