// Lays a closed skin around anything: the repair that always ends printable.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/mesh/clean/options.h"
#include "core/scan/mesh.h"

namespace gyre {

struct WrappedMesh {
  Mesh mesh;
  double alpha_mm = 0.0;  // as used
  double offset_mm = 0.0;
  double on_input_share = 0.0;  // of the vertices: drawn in all the way
};

// Wraps triangles, however broken, or the points of a mesh without triangles: closed, manifold,
// oriented, free of self-intersections. A ball of radius alpha is rolled from outside against the
// input grown by the offset, and goes through every opening wider than its diameter: cap the base
// first, or choose alpha above half the widest hole. The skin is then drawn in onto the input, each
// vertex as far as no triangles come to cross or fold; at sharp corners and in clefts some stay up
// to the offset outside. Attributes come from the nearest input. Triangles whose middle lies
// farther from the input than the offset and a quarter, the bridges over holes, get an unseen
// corner. The same input gives the same skin. Fails in words on an input without vertices or with
// coordinates that are no numbers, when alpha is so small against the input that more than some ten
// million triangles would be needed, and when stopped. Portaneri et al., "Alpha wrapping with an
// offset" (2022), by CGAL.
Result<WrappedMesh> wrapMesh(const Mesh& input, const WrapOptions& options, const Task& task);

}  // namespace gyre
