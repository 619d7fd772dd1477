// Writes GLB, glTF in one binary file: a surface with colours, for viewers and web pages.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/io/model_label.h"
#include "core/scan/mesh.h"

namespace gyre {

// The file's bytes, in the frame of glTF 2.0: metres and y up, so that (x, y, z) of the table
// becomes (x, z, -y) / 1000, standing on y = 0. With normals; colours as COLOR_0 are linear, 16
// bits a channel, and multiply a white that is neither metal nor gloss, seen from both sides.
// Fails as standingMesh() does, and beyond 2 GB.
Result<std::string> glbBytes(const Mesh& mesh, const ModelLabel& label = {});

// Replaces the file atomically.
Result<void> writeGlb(const std::filesystem::path& file, const Mesh& mesh,
                      const ModelLabel& label = {});

}  // namespace gyre
