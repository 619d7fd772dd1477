// Writes STL: triangles without colours, for printing. Reading: model_file.h.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/scan/mesh.h"

namespace gyre {

// The file's bytes: binary, in millimetres, z up, standing on z = 0. Fails as standingMesh() does.
Result<std::string> stlBytes(const Mesh& mesh);

// Replaces the file atomically.
Result<void> writeStl(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace gyre
