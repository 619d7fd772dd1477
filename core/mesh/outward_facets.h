// Chooses from an alpha shape the surface that its points look out of.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/mesh/alpha_filtration.h"
#include "core/scan/mesh.h"

namespace gyre {

// The outer facets whose outer side is the one that the normals of their corners look to, as far as
// `allows` lets them, chosen so that every edge has two triangles at most (selectManifold): those
// of smaller balls than alpha first, which follow clefts that alpha would bridge, and of these the
// smaller ones. vertices: of the filtration's points, with normals.
std::vector<Triangle> outwardFacets(const AlphaFiltration& filtration, double alpha,
                                    std::span<const MeshVertex> vertices,
                                    const std::function<bool(const AlphaFacet&)>& allows);

}  // namespace gyre
