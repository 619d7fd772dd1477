// Colours a surface from a scan's pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

// The mesh is of the result in `folder`, whose calibration.json and angles_solved.csv say where
// the camera stood and which pictures show what (colourVertices); each is taken from the first of
// the folders that has it. Gives how many vertices pictures showed. Fails when a file or a picture
// is missing or does not fit, or when stopped; the mesh is then as it was.
Result<std::size_t> colourFromPictures(Mesh& mesh, const std::filesystem::path& folder,
                                       const std::vector<std::filesystem::path>& pictures,
                                       const Task& task);

}  // namespace gyre
