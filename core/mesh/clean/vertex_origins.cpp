// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/vertex_origins.h"

#include <algorithm>
#include <numeric>

namespace gyre {
namespace {

bool before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

VertexOrigins::VertexOrigins(const Mesh& mesh) : mesh_(mesh), order_(mesh.vertices.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return before(mesh.vertices[a].position, mesh.vertices[b].position);
  });
}

std::uint32_t VertexOrigins::at(const Eigen::Vector3d& place) const {
  const auto found = std::lower_bound(order_.begin(), order_.end(), place,
                                      [&](std::uint32_t v, const Eigen::Vector3d& other) {
                                        return before(mesh_.vertices[v].position, other);
                                      });
  if (found == order_.end() || mesh_.vertices[*found].position != place) return kNone;
  return *found;
}

}  // namespace gyre
