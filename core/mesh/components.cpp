// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/components.h"

#include <limits>

#include <Eigen/Geometry>

#include "core/mesh/disjoint_sets.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

double areaOf(const Mesh& mesh, const Triangle& triangle) {
  const Eigen::Vector3d& a = mesh.vertices[triangle[0]].position;
  const Eigen::Vector3d ab = mesh.vertices[triangle[1]].position - a;
  const Eigen::Vector3d ac = mesh.vertices[triangle[2]].position - a;
  return 0.5 * ab.cross(ac).norm();
}

}  // namespace

MeshComponents findComponents(const Mesh& mesh) {
  DisjointSets sets(mesh.triangles.size());
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    for (auto use = begin; use != end; ++use) sets.join(begin->triangle, use->triangle);
  });
  MeshComponents components;
  components.of_triangle.resize(mesh.triangles.size());
  std::vector<std::uint32_t> number(mesh.triangles.size(), kNone);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& component = number[sets.find(t)];
    if (component == kNone) {
      component = static_cast<std::uint32_t>(components.area_mm2.size());
      components.area_mm2.push_back(0.0);
    }
    components.of_triangle[t] = component;
    components.area_mm2[component] += areaOf(mesh, mesh.triangles[t]);
  }
  return components;
}

void removeSmallComponents(Mesh& mesh, double min_share) {
  const MeshComponents components = findComponents(mesh);
  if (components.area_mm2.empty()) return;
  const double largest = *std::max_element(components.area_mm2.begin(), components.area_mm2.end());
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (components.area_mm2[components.of_triangle[t]] >= min_share * largest) {
      kept.push_back(mesh.triangles[t]);
    }
  }
  mesh.triangles = std::move(kept);
  removeUnusedVertices(mesh);
}

void removeUnusedVertices(Mesh& mesh) {
  std::vector<std::uint32_t> number(mesh.vertices.size(), kNone);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) number[corner] = 0;
  }
  std::vector<MeshVertex> kept;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(mesh.vertices[v]);
  }
  mesh.vertices = std::move(kept);
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = number[corner];
  }
}

}  // namespace gyre
