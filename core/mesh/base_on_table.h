// Lets the base of a surface rest on the table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// No camera sees how an object meets its platter: a closed surface is spanned between the lowest
// points that were seen, a little above the table z = 0. Where that is so, the patches of wide
// facets there that look down are brought to z = 0, with upright walls from where they were. They
// stand there on new vertices with seen = 0, one for each part where parts meet in a vertex alone.
// A vertex that noise has put below the table rises to it and stays its own foot. Nothing is
// changed where the lowest vertices, or most of these facets, are not near the table. A closed
// manifold stays one, of the same genus. spacing_mm: of each vertex, how far apart points lie
// there; grows with the vertices.
void restOnTable(Mesh& mesh, std::vector<double>& spacing_mm);

}  // namespace gyre
