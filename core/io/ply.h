// Writes points.ply, mesh.ply and truth.ply: binary, little endian. Reading: model_file.h.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

enum class MeshKind : std::uint8_t {
  kResult,  // float sigma_mm, ushort views, uchar seen
  kTruth,   // uint views_seen instead
};

// The file's bytes. Which views saw a point does not fit in: visibility_file.h.
std::string plyBytes(const PointCloud& cloud);
std::string plyBytes(const Mesh& mesh, MeshKind kind = MeshKind::kResult);

// Replace the file atomically.
Result<void> writePly(const std::filesystem::path& file, const PointCloud& cloud);
Result<void> writePly(const std::filesystem::path& file, const Mesh& mesh,
                      MeshKind kind = MeshKind::kResult);

}  // namespace gyre
