// Writes mesh.obj, with colours and normals at the vertices. Reading: model_file.h.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/scan/mesh.h"

namespace gyre {

// The file's text: "v x y z r g b" with colours in 0..1, "vn" where every normal is known, "f".
std::string objText(const Mesh& mesh);

// Replaces the file atomically.
Result<void> writeObj(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace gyre
