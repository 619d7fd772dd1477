// A closed triangle mesh of the surface where a sampled distance is zero.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/distance_lattice.h"
#include "core/scan/mesh.h"

namespace gyre {

// Every cube of the lattice is six tetrahedra around its diagonal (Kuhn's division, the same in all
// cubes), and the zero set is a plane in each: the surface is closed and manifold whatever the
// values, where the lattice's outer points are outside. Vertices lie on the edges of tetrahedra, at
// least a fiftieth of an edge from its ends, so that no triangle is without area. Oriented
// outward, with normals; in an order that depends on the lattice alone. Doi and Koide, "An
// efficient method of triangulating equi-valued surfaces by using tetrahedral cells" (1991).
Mesh marchingTetrahedra(const DistanceLattice& lattice);

}  // namespace gyre
