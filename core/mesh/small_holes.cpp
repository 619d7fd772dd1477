// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/small_holes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh/edges.h"

namespace gyre {
namespace {

using Rim = std::vector<std::uint32_t>;  // vertices in the order in which new triangles run
using EdgeSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

std::pair<std::uint32_t, std::uint32_t> edge(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// Cuts the boundary into simple loops. Where several holes meet at one vertex, a walk that comes
// back to a vertex closes the loop since its last visit.
std::vector<Rim> findRims(const std::vector<EdgeUse>& uses) {
  std::multimap<std::uint32_t, std::uint32_t> next;  // against the triangle at the edge
  forEachEdge(uses, [&](auto begin, auto end) {
    if (end - begin != 1) return;
    if (begin->forward) {
      next.emplace(begin->high, begin->low);
    } else {
      next.emplace(begin->low, begin->high);
    }
  });
  std::vector<Rim> rims;
  while (!next.empty()) {
    Rim path = {next.begin()->first};
    while (!path.empty()) {
      const auto step = next.find(path.back());
      if (step == next.end()) break;
      const std::uint32_t to = step->second;
      next.erase(step);
      const auto seen = std::find(path.begin(), path.end(), to);
      if (seen == path.end()) {
        path.push_back(to);
        continue;
      }
      rims.emplace_back(seen, path.end());
      path.erase(seen + 1, path.end());
    }
  }
  return rims;
}

double perimeter(const Mesh& mesh, const Rim& rim) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    sum +=
        (mesh.vertices[rim[(i + 1) % rim.size()]].position - mesh.vertices[rim[i]].position).norm();
  }
  return sum;
}

// Least-area triangulation of a polygon in space by dynamic programming over its chords:
//   cost(i, k) = min over j in (i, k) of cost(i, j) + cost(j, k) + area(i, j, k).
// G. Barequet and M. Sharir, "Filling gaps in the boundary of a polyhedron" (1995).
class RimFiller {
 public:
  RimFiller(const Mesh& mesh, const Rim& rim, const EdgeSet& existing)
      : mesh_(mesh), rim_(rim), existing_(existing), count_(rim.size()) {
    cost_.assign(count_ * count_, 0.0);
    middle_.assign(count_ * count_, 0);
  }

  std::optional<std::vector<Triangle>> fill() {
    for (std::size_t length = 2; length < count_; ++length) {
      for (std::size_t i = 0; i + length < count_; ++i) settle(i, i + length);
    }
    if (cost_[count_ - 1] == std::numeric_limits<double>::infinity()) return std::nullopt;
    std::vector<Triangle> triangles;
    collect(0, count_ - 1, triangles);
    return triangles;
  }

 private:
  void settle(std::size_t i, std::size_t k) {
    double best = std::numeric_limits<double>::infinity();
    const bool is_chord = k - i + 1 < count_;
    if (!is_chord || !existing_.contains(edge(rim_[i], rim_[k]))) {
      for (std::size_t j = i + 1; j < k; ++j) {
        const double cost = cost_[i * count_ + j] + cost_[j * count_ + k] + area(i, j, k);
        if (cost < best) {
          best = cost;
          middle_[i * count_ + k] = j;
        }
      }
    }
    cost_[i * count_ + k] = best;
  }

  double area(std::size_t i, std::size_t j, std::size_t k) const {
    const Eigen::Vector3d& at = mesh_.vertices[rim_[i]].position;
    const Eigen::Vector3d to_j = mesh_.vertices[rim_[j]].position - at;
    const Eigen::Vector3d to_k = mesh_.vertices[rim_[k]].position - at;
    return 0.5 * to_j.cross(to_k).norm();
  }

  void collect(std::size_t i, std::size_t k, std::vector<Triangle>& triangles) const {
    if (k - i < 2) return;
    const std::size_t j = middle_[i * count_ + k];
    triangles.push_back({rim_[i], rim_[j], rim_[k]});
    collect(i, j, triangles);
    collect(j, k, triangles);
  }

  const Mesh& mesh_;
  const Rim& rim_;
  const EdgeSet& existing_;
  std::size_t count_;
  std::vector<double> cost_;  // [i * count + k]
  std::vector<std::size_t> middle_;
};

}  // namespace

std::size_t closeSmallHoles(Mesh& mesh, const HoleLimits& limits) {
  const std::vector<EdgeUse> uses = edgeUses(mesh.triangles);
  EdgeSet existing;
  for (const EdgeUse& use : uses) existing.emplace(use.low, use.high);
  std::size_t closed = 0;
  for (const Rim& rim : findRims(uses)) {
    if (rim.size() < 3 || rim.size() > limits.max_edges) continue;
    if (perimeter(mesh, rim) > limits.max_perimeter_mm) continue;
    const auto triangles = RimFiller(mesh, rim, existing).fill();
    if (!triangles) continue;
    ++closed;
    for (const Triangle& triangle : *triangles) {
      for (std::size_t side = 0; side < 3; ++side) {
        existing.insert(edge(triangle[side], triangle[(side + 1) % 3]));
      }
      mesh.triangles.push_back(triangle);
    }
  }
  return closed;
}

}  // namespace gyre
