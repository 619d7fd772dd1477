// Tidies a division of space into solid and free cells, and returns its wall.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/tetrahedra.h"
#include "core/scan/mesh.h"

namespace gyre {

// Of each cell, whether it is solid. Cells that reach infinity are not.
using SolidCells = std::vector<char>;

// Makes free cells solid that cannot be reached from infinity through free cells.
void fillCavities(const Tetrahedra& tetrahedra, SolidCells& solid);

// Frees solid pieces (joined by sides) with less than the share of the largest one's volume.
void freeCrumbs(const Tetrahedra& tetrahedra, double min_share, SolidCells& solid);

// Makes cells solid, or frees some, until around every edge and every point the solid cells hang
// together by their sides, and the free ones too: the wall is then a 2-manifold. Each change is
// the smaller of the pieces that do not hang together. Returns how many points are left where that
// did not come to an end.
std::size_t makeManifold(const Tetrahedra& tetrahedra, SolidCells& solid);

// The sides between solid and free cells, counter-clockwise from the free ones.
std::vector<Triangle> wallOf(const Tetrahedra& tetrahedra, const SolidCells& solid);

}  // namespace gyre
