// The rims of a mesh: loops of edges with one triangle.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// Vertices in the order in which triangles that close the rim run along it.
using Rim = std::vector<std::uint32_t>;

// The rims by their smallest vertex, each beginning with it. The mesh has passed checkSurface.
std::vector<Rim> findRims(const Mesh& mesh);

}  // namespace gyre
