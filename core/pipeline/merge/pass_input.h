// One pass of several, read whole: what a merge takes from it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/report.h"
#include "core/io/sightings_file.h"
#include "core/pipeline/result_views.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"
#include "core/scan/silhouette.h"

namespace gyre {

// All in the pass's own table frame.
struct PassInput {
  std::filesystem::path folder;
  ResultViews views;
  PointCloud cloud;          // with the views of each point
  PointSightings sightings;  // empty when the result does not keep them
  Silhouettes silhouettes;   // likewise
  Mesh mesh;
  Report report;
};

// result: the folder of a finished scan or reconstruction, or the scan's file. Fails in words when
// points, mesh or what tells the cameras are missing or cannot be read, when the size of the result
// is not known, and when it is itself merged.
Result<PassInput> readPass(const std::filesystem::path& result);

}  // namespace gyre
