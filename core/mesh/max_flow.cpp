// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/max_flow.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <utility>

#include "core/base/check.h"

namespace gyre {
namespace {

// Where a node hangs in its tree: one of its four sides, or one of these.
enum Parent : std::uint8_t { kRoot = 4, kOrphan = 5, kNone = 6 };
enum class Tree : std::uint8_t { kFree, kSource, kSink };

constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kPathsBetweenLooks = 4096;

// Grows a tree of unsaturated arcs from the source and one towards the sink. Where they meet, flow
// is sent along the path; the nodes it cuts off look for a new parent or become free.
class TwoTrees {
 public:
  explicit TwoTrees(CellGraph graph)
      : neighbours_(std::move(graph.neighbours)),
        mirrors_(std::move(graph.mirrors)),
        residual_(std::move(graph.arc_costs)),
        terminal_(neighbours_.size()),
        tree_(neighbours_.size(), Tree::kFree),
        parent_(neighbours_.size(), kNone),
        depth_(neighbours_.size(), 0),
        checked_at_(neighbours_.size(), 0),
        is_active_(neighbours_.size(), 0) {
    for (std::uint32_t node = 0; node < neighbours_.size(); ++node) {
      const float from_source = graph.sink_costs[node];
      const float to_sink = graph.source_costs[node];
      flow_ += std::min(from_source, to_sink);
      terminal_[node] = from_source - to_sink;
      if (terminal_[node] != 0.0F) {
        plant(node, terminal_[node] > 0.0F ? Tree::kSource : Tree::kSink, kRoot, 1);
      }
    }
  }

  bool run(const Task& task) {
    for (std::size_t paths = 0; !active_.empty();) {
      const std::uint32_t node = active_.front();
      const int side = tree_[node] == Tree::kFree ? -1 : meetingSide(node);
      if (side < 0) {
        active_.pop_front();
        is_active_[node] = 0;
        continue;
      }
      ++now_;
      const auto from = tree_[node] == Tree::kSource ? Arc{node, side} : back({node, side});
      augment(from);
      adoptOrphans();
      if (++paths % kPathsBetweenLooks == 0 && task.stopRequested()) return false;
    }
    return true;
  }

  CellCut cut() const {
    CellCut result;
    result.cost = flow_;
    result.on_source_side.reserve(tree_.size());
    for (const Tree tree : tree_) result.on_source_side.push_back(tree == Tree::kSource ? 1 : 0);
    return result;
  }

 private:
  struct Arc {
    std::uint32_t node = 0;
    int side = 0;
  };

  std::uint32_t beyond(Arc arc) const {
    return neighbours_[arc.node][static_cast<std::size_t>(arc.side)];
  }
  Arc back(Arc arc) const {
    return {beyond(arc), mirrors_[arc.node][static_cast<std::size_t>(arc.side)]};
  }
  float& residual(Arc arc) { return residual_[arc.node][static_cast<std::size_t>(arc.side)]; }

  // What can still flow over a side in the sense of the node's tree: away from the source, or, in
  // the sink's tree, towards the node.
  float growth(Arc arc, Tree tree) { return residual(tree == Tree::kSource ? arc : back(arc)); }

  void plant(std::uint32_t node, Tree tree, std::uint8_t parent, std::uint32_t depth) {
    tree_[node] = tree;
    parent_[node] = parent;
    depth_[node] = depth;
    checked_at_[node] = now_;
    activate(node);
  }

  void activate(std::uint32_t node) {
    if (is_active_[node]) return;
    is_active_[node] = 1;
    active_.push_back(node);
  }

  // Takes in the free neighbours; the side on which the other tree was met, or -1.
  int meetingSide(std::uint32_t node) {
    const Tree tree = tree_[node];
    for (int side = 0; side < 4; ++side) {
      const Arc arc{node, side};
      if (growth(arc, tree) <= 0.0F) continue;
      const std::uint32_t other = beyond(arc);
      const auto to_parent = static_cast<std::uint8_t>(back(arc).side);
      if (tree_[other] == Tree::kFree) {
        plant(other, tree, to_parent, depth_[node] + 1);
        checked_at_[other] = checked_at_[node];
      } else if (tree_[other] != tree) {
        return side;
      } else if (checked_at_[other] <= checked_at_[node] && depth_[other] > depth_[node] + 1) {
        parent_[other] = to_parent;  // a shorter way to the root
        depth_[other] = depth_[node] + 1;
        checked_at_[other] = checked_at_[node];
      }
    }
    return -1;
  }

  // Calls visit(arc, child) for the arcs from `node` to its root, as flow goes along them, and
  // returns the root. The visit may cut the child off.
  template <class Visit>
  std::uint32_t climb(std::uint32_t node, const Visit& visit) {
    while (parent_[node] != kRoot) {
      const Arc up{node, parent_[node]};
      const std::uint32_t above = beyond(up);
      visit(tree_[node] == Tree::kSource ? back(up) : up, node);
      node = above;
    }
    return node;
  }

  // Sends what the path over `bridge`, from the source's tree to the sink's, can carry.
  void augment(Arc bridge) {
    float most = residual(bridge);
    const auto limit = [&](Arc arc, std::uint32_t) { most = std::min(most, residual(arc)); };
    const std::uint32_t ends[2] = {climb(bridge.node, limit), climb(beyond(bridge), limit)};
    for (const std::uint32_t end : ends) most = std::min(most, std::abs(terminal_[end]));

    const auto send = [&](Arc arc) {
      residual(arc) -= most;
      residual(back(arc)) += most;
    };
    const auto send_below = [&](Arc arc, std::uint32_t child) {
      send(arc);
      if (residual(arc) <= 0.0F) makeOrphan(child);
    };
    send(bridge);
    climb(bridge.node, send_below);
    climb(beyond(bridge), send_below);
    for (const std::uint32_t end : ends) {
      terminal_[end] += terminal_[end] > 0.0F ? -most : most;
      if (terminal_[end] == 0.0F) makeOrphan(end);
    }
    flow_ += most;
  }

  void makeOrphan(std::uint32_t node) {
    parent_[node] = kOrphan;
    orphans_.push_back(node);
  }

  void adoptOrphans() {
    while (!orphans_.empty()) {
      const std::uint32_t node = orphans_.front();
      orphans_.pop_front();
      if (!findParent(node)) release(node);
    }
  }

  // The number of arcs from a node to its root; kFar when an orphan is on the way. Marks the way,
  // so that it is not walked again before the next path.
  std::uint32_t depthOf(std::uint32_t start) {
    std::uint32_t steps = 0;
    std::uint32_t node = start;
    while (true) {
      if (checked_at_[node] == now_) {
        steps += depth_[node];
        break;
      }
      if (parent_[node] == kRoot) {
        checked_at_[node] = now_;
        depth_[node] = 1;
        steps += 1;
        break;
      }
      if (parent_[node] >= kOrphan) return kFar;
      node = beyond({node, parent_[node]});
      ++steps;
    }
    std::uint32_t depth = steps;
    for (node = start; checked_at_[node] != now_; node = beyond({node, parent_[node]})) {
      checked_at_[node] = now_;
      depth_[node] = depth--;
    }
    return steps;
  }

  bool findParent(std::uint32_t node) {
    const Tree tree = tree_[node];
    std::uint32_t best = kFar;
    for (int side = 0; side < 4; ++side) {
      const Arc arc{node, side};
      const std::uint32_t other = beyond(arc);
      if (tree_[other] != tree || parent_[other] >= kOrphan) continue;
      if (growth(back(arc), tree) <= 0.0F) continue;
      const std::uint32_t depth = depthOf(other);
      if (depth >= best) continue;
      best = depth;
      parent_[node] = static_cast<std::uint8_t>(side);
    }
    if (best == kFar) return false;
    checked_at_[node] = now_;
    depth_[node] = best + 1;
    return true;
  }

  // Frees a node that found no parent; its children are orphans then, and neighbours that could
  // take it in again must be asked.
  void release(std::uint32_t node) {
    const Tree tree = tree_[node];
    for (int side = 0; side < 4; ++side) {
      const Arc arc{node, side};
      const std::uint32_t other = beyond(arc);
      if (tree_[other] != tree) continue;
      if (growth(back(arc), tree) > 0.0F) activate(other);
      if (parent_[other] == back(arc).side) makeOrphan(other);
    }
    tree_[node] = Tree::kFree;
    parent_[node] = kNone;
  }

  std::vector<CellGraph::Four> neighbours_;
  std::vector<std::array<std::uint8_t, 4>> mirrors_;
  std::vector<std::array<float, 4>> residual_;
  std::vector<float> terminal_;  // what the source can still give; negative: what the sink can take
  std::vector<Tree> tree_;
  std::vector<std::uint8_t> parent_;
  std::vector<std::uint32_t> depth_;
  std::vector<std::uint32_t> checked_at_;  // when depth_ was known to hold
  std::vector<char> is_active_;
  std::deque<std::uint32_t> active_;
  std::deque<std::uint32_t> orphans_;
  std::uint32_t now_ = 0;
  double flow_ = 0.0;
};

}  // namespace

Result<CellCut> minimumCut(CellGraph graph, const Task& task) {
  const std::size_t nodes = graph.neighbours.size();
  GYRE_CHECK(graph.mirrors.size() == nodes && graph.arc_costs.size() == nodes &&
             graph.sink_costs.size() == nodes && graph.source_costs.size() == nodes);
  TwoTrees trees(std::move(graph));
  if (!trees.run(task)) return cancelled();
  return trees.cut();
}

}  // namespace gyre
