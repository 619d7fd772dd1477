// A result as other programs take it: pictures with their cameras, and points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/io/sightings_file.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct PosedPicture {
  std::string name;        // of its file; a COLMAP text model has no way to hold a blank in it
  Rigid3 cam_from_table;   // when it was taken: as if the camera went round the object
  std::string mask;        // file name below masks/, empty when there is none
  std::size_t camera = 0;  // among the cameras
};

struct PosedPictures {
  std::vector<CameraModel> cameras;    // one, where nobody changed it between pictures
  std::vector<PosedPicture> pictures;  // in the order of the views
  PointCloud cloud;                    // table frame, mm
  PointSightings sightings;            // of the cloud's points, or empty when nobody kept them
};

// A COLMAP text model as its documentation describes it: cameras.txt (OPENCV cameras, or
// FULL_OPENCV where the lens has a k3), images.txt and points3D.txt, in the folder, each
// atomically. COLMAP counts pixels from the picture's corner, where the centre of the first pixel
// is (0.5, 0.5). Lengths are millimetres in the table frame. Without sightings points have no
// tracks, and the error -1 that means "unknown".
//
// Fails when the camera's skew, which COLMAP has no number for, would be felt by more than a tenth
// of a pixel, and when a picture's name holds a blank.
Result<void> writeColmapModel(const std::filesystem::path& folder, const PosedPictures& posed);

// transforms.json as Instant-NGP and Nerfstudio read it: for each picture transform_matrix, from
// the camera's axes as OpenGL has them (x right, y up, z backwards) to the table frame, in
// millimetres. scale and offset are what brings the cloud into Instant-NGP's unit cube. Where
// there are several cameras, each frame has its own numbers. Pixels are counted from the picture's
// corner. Fails on a skew, as above.
Result<std::string> transformsText(const PosedPictures& posed);

}  // namespace gyre
