// Chooses triangles that together make a two-sided surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

struct TriangleCandidate {
  Triangle corners{};  // counter-clockwise from outside
  double cost = 0.0;   // the least is preferred
};

// Takes the candidates in the order of their cost, each if no triangle taken before runs along one
// of its edges in the same direction. So every edge ends with at most two triangles, and these
// agree on which side is outside. Candidates that already make such a surface are all taken.
std::vector<Triangle> selectManifold(std::vector<TriangleCandidate> candidates);

}  // namespace gyre
