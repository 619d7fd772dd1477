// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/unseen_patch.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/base/parallel.h"
#include "core/mesh/clean/blend.h"
#include "core/mesh/surface_index.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 1024;

bool isSeen(const Mesh& mesh, const Triangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t corner) { return mesh.vertices[corner].seen != 0; });
}

}  // namespace

MeshVertex unseenVertex(const Eigen::Vector3d& position, const Rgb& rgb) {
  MeshVertex vertex;
  vertex.position = position;
  vertex.rgb = rgb;
  vertex.seen = 0;
  return vertex;
}

void divideSeenTriangles(Mesh& mesh, std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t t : triangles) {
    if (!isSeen(mesh, mesh.triangles[t])) continue;
    const auto [a, b, c] = mesh.triangles[t];
    const MeshVertex mean = blend(std::array<WeightedVertex, 3>{{{&mesh.vertices[a], 1.0 / 3.0},
                                                                 {&mesh.vertices[b], 1.0 / 3.0},
                                                                 {&mesh.vertices[c], 1.0 / 3.0}}});
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(unseenVertex(mean.position, mean.rgb));
    mesh.vertices.back().normal = mean.normal;
    mesh.triangles[t] = {a, b, middle};
    mesh.triangles.push_back({b, c, middle});
    mesh.triangles.push_back({c, a, middle});
  }
}

void divideSeenTriangles(Mesh& mesh, std::uint32_t first) {
  std::vector<std::uint32_t> triangles(mesh.triangles.size() - first);
  std::iota(triangles.begin(), triangles.end(), first);
  divideSeenTriangles(mesh, triangles);
}

std::vector<std::uint32_t> seenOverUnseen(const Mesh& source, const Mesh& mesh) {
  if (std::all_of(source.vertices.begin(), source.vertices.end(),
                  [](const MeshVertex& vertex) { return vertex.seen != 0; })) {
    return {};
  }
  const SurfaceIndex index(source);
  std::vector<std::uint8_t> is_over(mesh.triangles.size(), 0);
  parallelFor(is_over.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (!isSeen(mesh, mesh.triangles[t])) continue;
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const std::uint32_t corner : mesh.triangles[t]) {
        middle += mesh.vertices[corner].position / 3.0;
      }
      is_over[t] = isSeen(source, source.triangles[index.nearest(middle).piece]) ? 0 : 1;
    }
  });
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < is_over.size(); ++t) {
    if (is_over[t] != 0) found.push_back(t);
  }
  return found;
}

}  // namespace gyre
