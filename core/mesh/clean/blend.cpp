// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/blend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/surface_index.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 1024;

}  // namespace

MeshVertex blend(std::span<const WeightedVertex> parts) {
  MeshVertex mean;
  Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
  double sigma_mm = 0.0;
  double views = 0.0;
  double seen = 0.0;
  for (const auto& [vertex, weight] : parts) {
    mean.position += weight * vertex->position;
    mean.normal += weight * vertex->normal;
    rgb += weight * Eigen::Vector3d(vertex->rgb[0], vertex->rgb[1], vertex->rgb[2]);
    sigma_mm += weight * static_cast<double>(vertex->sigma_mm);
    views += weight * vertex->views;
    if (vertex->seen != 0) seen += weight;
  }
  mean.normal = mean.normal.stableNormalized();
  for (std::size_t i = 0; i < 3; ++i) {
    mean.rgb[i] = static_cast<std::uint8_t>(
        std::lround(std::clamp(rgb[static_cast<Eigen::Index>(i)], 0.0, 255.0)));
  }
  // Weights of a place on an edge may be negative by rounding.
  mean.sigma_mm = static_cast<float>(std::max(0.0, sigma_mm));
  mean.views = static_cast<std::uint16_t>(std::lround(std::max(0.0, views)));
  mean.seen = seen >= 0.5 ? 1 : 0;
  return mean;
}

void carryAttributes(const Mesh& source, Mesh& mesh, std::uint32_t first) {
  const SurfaceIndex index(source);
  parallelFor(mesh.vertices.size() - first, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = first + begin; i < first + end; ++i) {
      const Eigen::Vector3d position = mesh.vertices[i].position;
      const SurfaceHit hit = index.nearest(position);
      if (source.triangles.empty()) {
        mesh.vertices[i] = source.vertices[hit.piece];
      } else {
        const auto& [a, b, c] = source.triangles[hit.piece];
        mesh.vertices[i] =
            blend(std::array<WeightedVertex, 3>{{{&source.vertices[a], hit.weights[0]},
                                                 {&source.vertices[b], hit.weights[1]},
                                                 {&source.vertices[c], hit.weights[2]}}});
      }
      mesh.vertices[i].position = position;
    }
  });
}

}  // namespace gyre
