// Finds where a surface was closed below, a little above the table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// Of the triangles that are only guessed those that look down, in patches that hang together by
// edges: the triangles of the patches that lie below the height as a whole, ascending. None when
// such patches above the height are larger together: resting on the lesser part of its base an
// object would stand crooked.
std::vector<std::uint32_t> baseFacets(const Mesh& mesh,
                                      const std::function<bool(const Triangle&)>& is_guessed,
                                      double below_mm);

// The same without triangles that meet others of them in a single vertex: what is left has a rim
// that touches itself nowhere.
std::vector<std::uint32_t> withoutPinched(const Mesh& mesh, std::vector<std::uint32_t> triangles);

// Directed edges that one of these triangles has and none of the others shares.
struct DirectedEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t of = 0;  // the triangle's place in the list
};
std::vector<DirectedEdge> rimOf(const Mesh& mesh, const std::vector<std::uint32_t>& triangles);

// The corners of these triangles.
std::vector<Triangle> cornersOf(const Mesh& mesh, const std::vector<std::uint32_t>& triangles);

}  // namespace gyre
