// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/max_flow.h"

#include <stop_token>
#include <utility>

#include <gtest/gtest.h>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include "core/base/random.h"
#include "core/mesh/tetrahedra.h"

namespace gyre {
namespace {

// What an independent program says of the same graph.
double costByBoost(const CellGraph& graph) {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Edge = Traits::edge_descriptor;
  using Graph = boost::adjacency_list<
      boost::vecS, boost::vecS, boost::directedS,
      boost::property<
          boost::vertex_index_t, std::size_t,
          boost::property<boost::vertex_color_t, boost::default_color_type,
                          boost::property<boost::vertex_distance_t, double,
                                          boost::property<boost::vertex_predecessor_t, Edge>>>>,
      boost::property<boost::edge_capacity_t, double,
                      boost::property<boost::edge_residual_capacity_t, double,
                                      boost::property<boost::edge_reverse_t, Edge>>>>;
  const std::size_t nodes = graph.neighbours.size();
  Graph flow(nodes + 2);
  const auto capacity = get(boost::edge_capacity, flow);
  const auto reverse = get(boost::edge_reverse, flow);
  const auto join = [&](std::size_t from, std::size_t to, double there, double back) {
    const Edge forth = add_edge(from, to, flow).first;
    const Edge home = add_edge(to, from, flow).first;
    capacity[forth] = there;
    capacity[home] = back;
    reverse[forth] = home;
    reverse[home] = forth;
  };
  for (std::size_t node = 0; node < nodes; ++node) {
    join(nodes, node, graph.sink_costs[node], 0.0);
    join(node, nodes + 1, graph.source_costs[node], 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t other = graph.neighbours[node][i];
      const std::size_t mirror = graph.mirrors[node][i];
      if (std::pair(node, i) < std::pair(other, mirror)) {
        join(node, other, graph.arc_costs[node][i], graph.arc_costs[other][mirror]);
      }
    }
  }
  return boykov_kolmogorov_max_flow(flow, nodes, nodes + 1);
}

double costOf(const CellGraph& graph, const std::vector<char>& on_source_side) {
  double cost = 0.0;
  for (std::size_t node = 0; node < on_source_side.size(); ++node) {
    cost += on_source_side[node] ? graph.source_costs[node] : graph.sink_costs[node];
    for (std::size_t i = 0; i < 4; ++i) {
      if (on_source_side[node] && !on_source_side[graph.neighbours[node][i]]) {
        cost += graph.arc_costs[node][i];
      }
    }
  }
  return cost;
}

// The cells of a triangulation of random points, with whole costs so that sums are exact.
CellGraph randomGraph(std::size_t points, std::uint64_t seed, double share_of_terminals) {
  Random random(seed);
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < points; ++i) {
    places.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  const auto cells = delaunay(std::move(places), {});
  CellGraph graph;
  graph.neighbours = cells->neighbours;
  graph.mirrors = cells->mirrors;
  for (std::size_t node = 0; node < cells->cells(); ++node) {
    auto& arcs = graph.arc_costs.emplace_back();
    for (float& cost : arcs) cost = static_cast<float>(static_cast<int>(random.uniform() * 20.0));
    const bool ends = random.uniform() < share_of_terminals;
    graph.sink_costs.push_back(ends ? static_cast<float>(static_cast<int>(random.uniform() * 90.0))
                                    : 0.0F);
    graph.source_costs.push_back(
        ends ? static_cast<float>(static_cast<int>(random.uniform() * 90.0)) : 0.0F);
  }
  return graph;
}

TEST(MinimumCut, CostsWhatAnIndependentProgramSays) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const CellGraph graph = randomGraph(20 + 20 * seed, seed, seed % 2 == 0 ? 0.05 : 0.6);
    const auto cut = minimumCut(graph, {});
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->cost, costByBoost(graph)) << "seed " << seed;
    EXPECT_EQ(costOf(graph, cut->on_source_side), cut->cost) << "seed " << seed;
  }
}

// Two nodes in a row, the other sides joined to themselves at no cost.
CellGraph pair(float forth, float back) {
  CellGraph graph;
  graph.neighbours = {{1, 0, 0, 0}, {0, 1, 1, 1}};
  graph.mirrors = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  graph.arc_costs = {{forth, 0, 0, 0}, {back, 0, 0, 0}};
  graph.sink_costs = {5.0F, 0.0F};
  graph.source_costs = {0.0F, 3.0F};
  return graph;
}

TEST(MinimumCut, GoesWhereItIsCheapest) {
  const auto between = minimumCut(pair(2.0F, 9.0F), {});
  EXPECT_EQ(between->cost, 2.0);
  EXPECT_EQ(between->on_source_side, (std::vector<char>{1, 0}));
  const auto beyond = minimumCut(pair(4.0F, 0.0F), {});
  EXPECT_EQ(beyond->cost, 3.0);
  EXPECT_EQ(beyond->on_source_side, (std::vector<char>{1, 1}));
}

TEST(MinimumCut, LeavesNothingOnTheSourcesSideThatCostsNothingOnTheOther) {
  CellGraph graph = pair(0.0F, 0.0F);
  graph.sink_costs = {0.0F, 0.0F};
  graph.source_costs = {0.0F, 0.0F};
  EXPECT_EQ(minimumCut(graph, {})->on_source_side, (std::vector<char>{0, 0}));
}

TEST(MinimumCut, OfNothingIsNothing) {
  const auto cut = minimumCut({}, {});
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->cost, 0.0);
  EXPECT_TRUE(cut->on_source_side.empty());
}

TEST(MinimumCut, HearsAStop) {
  std::stop_source stop;
  stop.request_stop();
  const auto cut = minimumCut(randomGraph(20000, 3, 0.5), Task(stop.get_token()));
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
