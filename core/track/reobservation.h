// Looks for points whose place and surface are known in every view that can show them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/camera_model.h"
#include "core/geometry/rigid3.h"
#include "core/scan/frame.h"
#include "core/scan/track.h"
#include "core/track/options.h"

namespace gyre {

// A view to look in. Views are counted from 0.
struct GreyView {
  cv::Mat grey;              // 8 bit, 1 channel
  Rigid3 cam_from_table;     // where the table truly stood
  double noise_sigma = 0.0;  // of the grey, in grey levels
};

// A point with the surface around it.
struct SurfacePoint {
  Eigen::Vector3d position_in_table;       // mm
  Eigen::Vector3d normal_in_table;         // unit length, outwards
  Eigen::Matrix3d bending_in_table;        // rise along the normal: d'Bd / 2 [1/mm]
  std::span<const std::uint32_t> seen_by;  // views that are known to show it
};

// The observations of each point, ascending views; none when no view gives a patch of it.
//
// Of the views that are known to show a point, the one that meets its surface most squarely gives
// the reference patch. In every view that its normal faces within 70 degrees, or nearly as
// squarely as any where none does, the patch is laid where the point and
// the surface around it must appear and aligned from there (ReferencePatch): all sightings of a
// point are held against one patch, so that nothing drifts, and a track reaches as far round as the
// surface can be seen. A view in which something hides the point does not look like the patch.
// Where more views face a point than options.most_views, they are taken evenly among them.
//
// Fails when the task is stopped. The same result for any number of threads.
Result<std::vector<std::vector<Observation>>> reobserve(const CameraModel& camera,
                                                        std::span<const GreyView> views,
                                                        std::span<const SurfacePoint> points,
                                                        const TrackOptions& options,
                                                        const Task& task);

}  // namespace gyre
