// Tells which triangles hang together around each vertex.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/disjoint_sets.h"
#include "core/mesh/edges.h"
#include "core/scan/mesh.h"

namespace gyre {

// A fan is a run of triangles around one vertex, each joined to the next across an edge. A vertex
// of a proper surface has exactly one.
struct VertexFans {
  std::vector<std::uint32_t> of_corner;  // [3 * triangle + place], numbered by first corner
  std::vector<std::uint32_t> vertex;     // of each fan

  // The fan of that triangle at that vertex, which is one of its corners.
  std::uint32_t at(const std::vector<Triangle>& triangles, std::uint32_t triangle,
                   std::uint32_t of_vertex) const;
};

// Joins triangles across edges, then numbers the fans that this makes. The triangles outlive it.
class FanBuilder {
 public:
  explicit FanBuilder(const std::vector<Triangle>& triangles);

  // Both are uses of the same edge.
  void join(const EdgeUse& a, const EdgeUse& b);
  VertexFans build();

 private:
  const std::vector<Triangle>& triangles_;
  DisjointSets corners_;
};

// The fans when all triangles at an edge are joined, however many they are.
VertexFans findFans(const std::vector<Triangle>& triangles);

}  // namespace gyre
