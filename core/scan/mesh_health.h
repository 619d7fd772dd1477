// What is to be known of a mesh before it is printed or measured.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

namespace gyre {

struct MeshHealth {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;
  std::size_t boundary_edges = 0;         // edges with one triangle
  std::size_t non_manifold_edges = 0;     // edges with more than two
  std::size_t non_manifold_vertices = 0;  // where triangles meet that share no edge there
  std::size_t holes = 0;                  // loops of boundary edges, an open base among them
  bool closed = false;                    // no boundary edge
  bool manifold = false;                  // no non-manifold edge
  long euler_number = 0;                  // vertices in use - edges + triangles
  // Handles of the body: 0 for a ball, 1 for a cup. Only where the mesh is closed, without
  // non-manifold edge or vertex, and one component.
  std::optional<long> genus;
  // Pairs of triangles that meet elsewhere than in a shared edge or vertex. Nothing: not counted.
  std::optional<std::size_t> self_intersections;
  double area_mm2 = 0.0;
  double unseen_area_mm2 = 0.0;  // of the triangles with a corner that no camera saw
  double volume_mm3 = 0.0;       // signed; meaningful when closed
};

}  // namespace gyre
