// Colours a surface from the pictures that show it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/posed_camera.h"
#include "core/scan/frame.h"
#include "core/scan/mesh.h"

namespace gyre {

// The picture of one of the views, 8 bit BGR, of its camera's size.
using PictureOfView = std::function<Result<cv::Mat>(std::size_t view)>;

// Each vertex gets the weighted median of its colours in the pictures that show it unhidden and at
// less than 70 degrees from its normal, weighted by the cosine of that angle: a highlight wanders
// over the surface as the table turns and stays in the minority. At most 36 pictures, spread over
// the views, are asked, one after the other. A vertex that none shows takes the mean of its
// neighbours that have a colour, and so on outward; with no neighbour it keeps its own. Sets rgb
// and views of the vertices; their normals must be known. Gives how many vertices pictures showed.
// Fails when a picture cannot be had or is of another size, or when stopped; the mesh is then as it
// was.
Result<std::size_t> colourVertices(Mesh& mesh, std::span<const PosedCamera> cameras,
                                   const PictureOfView& picture_of, const Task& task);

// Each vertex gets the colour of the nearest point of the cloud, which is not empty.
void colourFromPoints(Mesh& mesh, const PointCloud& cloud);

}  // namespace gyre
