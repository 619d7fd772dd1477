// Attributes of vertices that a step of cleaning up places between others.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "core/scan/mesh.h"

namespace gyre {

struct WeightedVertex {
  const MeshVertex* vertex = nullptr;
  double weight = 0.0;
};

// The weighted mean of position, normal, colour, sigma and views; seen where the seen ones weigh at
// least half. Weights are not negative and sum to one.
MeshVertex blend(std::span<const WeightedVertex> parts);

// Takes all but the positions of the vertices from `first` on from the nearest place on the
// source's surface, or from its nearest point where it has no triangles. The source has a vertex.
// The same for any number of threads.
void carryAttributes(const Mesh& source, Mesh& mesh, std::uint32_t first = 0);

}  // namespace gyre
