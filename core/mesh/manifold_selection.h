// Chooses triangles that together make a two-sided surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

struct TriangleCandidate {
  Triangle corners{};  // counter-clockwise from outside
  int level = 0;       // all of a lower level come before any of a higher one
  double cost = 0.0;   // within a level the least is preferred
};

// Takes the candidates by level and cost, each if no triangle taken before runs along one of its
// edges in the same direction, and none of its corners is already surrounded by triangles. So every
// edge ends with at most two triangles, which agree on which side is outside, and higher levels
// fill the gaps of the lower ones without covering them. A candidate given twice is taken once.
std::vector<Triangle> selectManifold(std::vector<TriangleCandidate> candidates);

}  // namespace gyre
