// CGAL's alpha wrap of triangles or points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/mesh.h"

namespace gyre {

struct WrapSize {
  double alpha_mm = 0.0;
  double offset_mm = 0.0;
};

// The wrap as it is laid, the offset outside of the input's triangles, or its vertices when it has
// none; vertices have a position only. Sizes are positive. Fails in words when stopped, and where
// CGAL fails.
Result<Mesh> alphaWrap(const Mesh& input, const WrapSize& size, const Task& task);

}  // namespace gyre
