// Moves a result onto a reference, for comparisons of things measured in different frames.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/geometry/rigid3.h"
#include "core/scan/mesh.h"

namespace gyre {

// reference_from_result: the rotation and shift, without scaling, that bring the result's surface
// nearest to the reference's, from a start within a few percent and 20 degrees or so of the answer.
// Iterated closest points, point to plane where the reference has triangles, the worst tenth of the
// pairs left out. Neither mesh is empty and all coordinates are finite. Fails when the shapes leave
// the motion open (three points in a line, say).
Result<Rigid3> alignRigidly(const Mesh& result, const Mesh& reference, const Task& task);

}  // namespace gyre
