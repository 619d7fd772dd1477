// Draws a skin that was laid outside of a surface in onto it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

// Moves each vertex of the skin to its target, or a half, a quarter, an eighth of the way or not at
// all, so that no triangles cross, fold or vanish that did not before. Returns the share of the way
// that each went. The skin has passed checkSurface and does not cross itself; targets are one for
// each vertex. Fails when stopped; the skin is then in between.
Result<std::vector<double>> drawIn(Mesh& skin, const std::vector<Eigen::Vector3d>& targets,
                                   const Task& task);

}  // namespace gyre
