// What gyre mesh reads: the points, how they were seen, and the pictures they were seen in.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/mesh/sight_evidence.h"
#include "core/scan/mesh_method.h"
#include "core/scan/point_cloud.h"

namespace gyre {

struct MeshInput {
  std::filesystem::path folder;  // of the points
  PointCloud cloud;              // with the views of each point, where these are known
  std::optional<SightEvidence> sights;
};

// input: a result's folder, a scan's folder or file, or a file of points. Sights are known where
// files of one reconstruction lie together. A body from outlines needs no points: for that method
// the cloud may be empty or missing. Fails when a file is missing or cannot be read.
Result<MeshInput> readMeshInput(const std::string& input, MeshMethod method);

}  // namespace gyre
