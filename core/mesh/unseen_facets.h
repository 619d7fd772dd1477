// Marks what of a surface no camera saw.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/scan/mesh.h"

namespace gyre {

// Whether a triangle is much wider than the points at its corners lie apart: it spans a place where
// nothing was measured. spacing_mm: of each vertex.
bool isWideFacet(const Mesh& mesh, std::span<const double> spacing_mm, const Triangle& triangle);

// Gives every wide triangle that has a seen corner a vertex in its middle, with seen = 0. The
// surface stays where it is.
void markWideFacets(Mesh& mesh, std::span<const double> spacing_mm);

}  // namespace gyre
