// The cheapest division of the cells of a triangulation into two sets.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

// A graph of nodes with four neighbours each, as the cells of a triangulation are, between a source
// and a sink. All arrays are by node; capacities are finite and not negative.
struct CellGraph {
  using Four = std::array<std::uint32_t, 4>;

  std::vector<Four> neighbours;
  std::vector<std::array<std::uint8_t, 4>> mirrors;  // which of the neighbour's four it is
  // Cost of the node being on the source's side while the neighbour is on the sink's.
  std::vector<std::array<float, 4>> arc_costs;
  std::vector<float> sink_costs;    // of the node being on the sink's side
  std::vector<float> source_costs;  // of the node being on the source's side
};

struct CellCut {
  std::vector<char> on_source_side;  // of each node
  double cost = 0.0;                 // of all arcs cut: the least there is
};

// The division of least cost; of several, the one with the smallest source side. Fails when the
// task is stopped. Takes the graph, whose costs it uses up. One thread; the same graph gives the
// same cut. Boykov and Kolmogorov, "An experimental comparison of min-cut/max-flow algorithms for
// energy minimization in vision" (2004).
Result<CellCut> minimumCut(CellGraph graph, const Task& task);

}  // namespace gyre
