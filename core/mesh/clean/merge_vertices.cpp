// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/merge_vertices.h"

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "core/mesh/clean/check_input.h"
#include "core/mesh/components.h"
#include "core/mesh/kd_tree.h"

namespace gyre {
namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kAskEvery = 4096;  // vertices between two looks at the stop request

// For each vertex the one that it becomes; empty when stopped.
std::vector<std::uint32_t> findMasters(const Mesh& mesh, double within_mm, const Task& task) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) positions.push_back(vertex.position);
  const KdTree tree(std::move(positions));
  std::vector<std::uint32_t> master(mesh.vertices.size(), kNone);
  for (std::uint32_t v = 0; v < master.size(); ++v) {
    if (v % kAskEvery == 0 && task.stopRequested()) return {};
    if (master[v] != kNone) continue;
    for (const KdTree::Neighbour& near : tree.within(tree.point(v), within_mm)) {
      if (master[near.index] == kNone) master[near.index] = v;
    }
  }
  return master;
}

// The same triangle for each of the three corners it may begin with.
Triangle fromSmallest(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

}  // namespace

Result<MergedMesh> mergeVertices(const Mesh& mesh, const MergeOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  const std::vector<std::uint32_t> master = findMasters(mesh, options.within_mm, task);
  if (task.stopRequested()) return cancelled();

  MergedMesh merged;
  merged.mesh.vertices = mesh.vertices;
  for (std::uint32_t v = 0; v < master.size(); ++v) {
    if (master[v] != v) ++merged.vertices_merged;
  }
  std::set<Triangle> taken;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Triangle triangle = {master[a], master[b], master[c]};
    const bool has_area =
        triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
    if (has_area && taken.insert(fromSmallest(triangle)).second) {
      merged.mesh.triangles.push_back(triangle);
    }
  }
  merged.triangles_removed = mesh.triangles.size() - merged.mesh.triangles.size();
  removeUnusedVertices(merged.mesh);
  return merged;
}

}  // namespace gyre
