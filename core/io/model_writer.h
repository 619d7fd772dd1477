// Writes a mesh to whatever format its file's name asks for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/model_label.h"
#include "core/scan/mesh.h"

namespace gyre {

// Replaces the file atomically, in the format of its ending: .ply and .obj in the table frame,
// .stl, .3mf and .glb standing on z = 0 (standing_mesh.h); millimetres and z up, but for .glb,
// which is in metres and y up. Fails on other endings. The label goes into .3mf and .glb.
Result<void> writeModel(const std::filesystem::path& file, const Mesh& mesh,
                        const ModelLabel& label = {});

// How far that moves the mesh along z, so that its lowest corner is at 0: nothing for .ply and
// .obj. Where a base was not seen it can be millimetres, and the user should hear of it. [mm]
double movedAlongZ_mm(const std::filesystem::path& file, const Mesh& mesh);

// Fails with the same sentence where writeModel() would not know the ending: to be asked before a
// long computation.
Result<void> checkModelEnding(const std::filesystem::path& file);

}  // namespace gyre
