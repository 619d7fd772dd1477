// A triangle mesh of the surface where a function is zero.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/distance_lattice.h"
#include "core/scan/mesh.h"

namespace gyre {

// By so much a distance may exceed the true one away from the surface, as blended ellipsoids do.
inline constexpr double kMostStretchOutside = 2.0;
inline constexpr double kMostStretchInside = 5.0;

// The closed surface inside the box, oriented outward, with vertices about cell_mm apart that lie
// on the zero set to 1e-3 of a cell wherever it is smooth. Normals are set. The zero set must stay
// inside the box. Surface nets: Gibson, "Constrained elastic surface nets" (1998), with the
// vertices then brought to the zero set by Newton's method instead of relaxed.
Mesh meshOfImplicit(const SignedDistance& distance, const Bounds& box, double cell_mm);

}  // namespace gyre
