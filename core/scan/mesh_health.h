// What is to be known of a mesh before it is printed or measured.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace gyre {

struct MeshHealth {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;
  std::size_t boundary_edges = 0;      // edges with one triangle
  std::size_t non_manifold_edges = 0;  // edges with more than two
  bool closed = false;                 // no boundary edge
  bool manifold = false;               // no non-manifold edge
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;  // signed; meaningful when closed
};

}  // namespace gyre
