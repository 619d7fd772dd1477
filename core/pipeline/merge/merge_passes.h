// Makes one model of several scans of an object that was turned over between them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/report.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"
#include "core/scan/scan_pass.h"

namespace gyre {

struct MergeRequest {
  // Folders of finished scans or reconstructions, or scans' files; two or more. The first gives the
  // merged model its table frame: it stands as it stood there.
  std::vector<std::filesystem::path> passes;
  std::filesystem::path out;  // of none of the passes
  Report report;              // date and versions; the rest is filled in
};

struct MergedPasses {
  std::vector<ScanPass> passes;
  PointCloud cloud;
  Mesh mesh;                          // empty when none could be made
  std::optional<Error> mesh_problem;  // why
};

// Finds how the passes lie on each other (placePasses) and writes, each file atomically:
// passes.json and in pass-1/, pass-2/, ... what tells the cameras of each; points.ply,
// visibility.bin, sightings.bin, silhouettes.bin of all together, views numbered through;
// calibration.json of the first; mesh.ply and mesh.obj, a surface of all points and all lines of
// sight, coloured from the pictures; report.json and report.html. What needs a result takes the
// folder like any other. Fails when a pass cannot be read or has no place among the others, when a
// file cannot be written, and when stopped; before the passes have their places nothing is written.
Result<MergedPasses> mergePasses(const MergeRequest& request, const Task& task);

}  // namespace gyre
