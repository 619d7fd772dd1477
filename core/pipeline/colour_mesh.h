// Colours a surface from a scan's pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/result_pictures.h"
#include "core/scan/mesh.h"

namespace gyre {

// The mesh is of the result in `folder`, whose files say where the camera stood and which pictures
// show what (readResultViews, colourVertices). Gives how many vertices pictures showed. Fails when
// a file or a picture is missing or does not fit, or when stopped; the mesh is then as it was.
Result<std::size_t> colourFromPictures(Mesh& mesh, const std::filesystem::path& folder,
                                       const PictureFinder& pictures, const Task& task);

}  // namespace gyre
