// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/split_non_manifold.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/components.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

struct UseAround {
  EdgeUse use;
  double angle_rad = 0.0;  // about the edge, counter-clockwise seen against its direction
};

// The triangles at the edge in the order in which a page turned about it would meet them.
std::vector<UseAround> sortedAround(const Mesh& mesh, const EdgeUse* begin, const EdgeUse* end) {
  const Eigen::Vector3d& low = mesh.vertices[begin->low].position;
  const Eigen::Vector3d axis = (mesh.vertices[begin->high].position - low).stableNormalized();
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.cross(x);
  std::vector<UseAround> around;
  for (const EdgeUse* use = begin; use != end; ++use) {
    const Triangle& corners = mesh.triangles[use->triangle];
    const std::uint32_t opposite = corners[0] ^ corners[1] ^ corners[2] ^ use->low ^ use->high;
    const Eigen::Vector3d away = mesh.vertices[opposite].position - low;
    around.push_back({*use, std::atan2(away.dot(y), away.dot(x))});
  }
  // Of two in the same place the one that ends a body comes first.
  std::stable_sort(around.begin(), around.end(), [](const UseAround& a, const UseAround& b) {
    if (a.angle_rad != b.angle_rad) return a.angle_rad < b.angle_rad;
    return a.use.forward && !b.use.forward;
  });
  return around;
}

// A triangle that runs against the edge has the body on the side that the page turns to next, one
// that runs along it on the other: they pair like brackets.
void joinBodies(const Mesh& mesh, const EdgeUse* begin, const EdgeUse* end, FanBuilder& fans) {
  const std::vector<UseAround> around = sortedAround(mesh, begin, end);
  enum class State { kFree, kOpen, kPaired };
  std::vector<State> states(around.size(), State::kFree);
  std::vector<std::size_t> open;
  for (std::size_t step = 0; step < 2 * around.size(); ++step) {
    const std::size_t i = step % around.size();
    if (states[i] != State::kFree) continue;
    if (!around[i].use.forward) {
      states[i] = State::kOpen;
      open.push_back(i);
    } else if (!open.empty()) {
      fans.join(around[open.back()].use, around[i].use);
      states[open.back()] = State::kPaired;
      states[i] = State::kPaired;
      open.pop_back();
    }
  }
}

VertexFans fansOfBodies(const Mesh& mesh) {
  FanBuilder fans(mesh.triangles);
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    if (end - begin == 2) fans.join(*begin, *(begin + 1));
    if (end - begin > 2) joinBodies(mesh, &*begin, &*begin + (end - begin), fans);
  });
  return fans.build();
}

// Removes the third and further triangles at each edge; returns how many.
std::size_t removeCrowding(Mesh& mesh) {
  std::vector<bool> crowding(mesh.triangles.size(), false);
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    std::ptrdiff_t stay = 2;
    for (auto use = begin; use != end; ++use) {
      if (!crowding[use->triangle] && stay-- <= 0) crowding[use->triangle] = true;
    }
  });
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!crowding[t]) kept.push_back(mesh.triangles[t]);
  }
  const std::size_t removed = mesh.triangles.size() - kept.size();
  mesh.triangles = std::move(kept);
  return removed;
}

// Removes triangles with fewer than three different corners; returns how many.
std::size_t removeFlat(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [](const Triangle& corners) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
  });
}

}  // namespace

std::size_t separateFans(Mesh& mesh, const VertexFans& fans) {
  const std::size_t before = mesh.vertices.size();
  std::vector<bool> taken(before, false);
  std::vector<std::uint32_t> vertex_of_fan(fans.vertex.size());
  for (std::size_t fan = 0; fan < fans.vertex.size(); ++fan) {
    const std::uint32_t vertex = fans.vertex[fan];
    if (!taken[vertex]) {
      taken[vertex] = true;
      vertex_of_fan[fan] = vertex;
    } else {
      vertex_of_fan[fan] = static_cast<std::uint32_t>(mesh.vertices.size());
      const MeshVertex copy = mesh.vertices[vertex];
      mesh.vertices.push_back(copy);
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t place = 0; place < 3; ++place) {
      mesh.triangles[t][place] = vertex_of_fan[fans.of_corner[3 * t + place]];
    }
  }
  return mesh.vertices.size() - before;
}

Result<SplitMesh> splitNonManifold(const Mesh& mesh, const Task& task) {
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  SplitMesh split;
  split.mesh = mesh;
  split.triangles_removed = removeFlat(split.mesh);
  // Removing triangles can leave fans of its own, and every round that removes none is the last.
  std::size_t removed = 0;
  do {
    if (task.stopRequested()) return cancelled();
    split.vertices_added += separateFans(split.mesh, fansOfBodies(split.mesh));
    removed = removeCrowding(split.mesh);
    split.triangles_removed += removed;
  } while (removed > 0);
  removeUnusedVertices(split.mesh);
  return split;
}

}  // namespace gyre
