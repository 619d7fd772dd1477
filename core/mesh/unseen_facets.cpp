// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/unseen_facets.h"

#include <algorithm>
#include <cstddef>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr double kWideSpacings = 4.0;

MeshVertex middleOf(const Mesh& mesh, const Triangle& triangle) {
  MeshVertex middle;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    int sum = 0;
    for (const std::uint32_t corner : triangle) sum += mesh.vertices[corner].rgb[channel];
    middle.rgb[channel] = static_cast<std::uint8_t>(sum / 3);
  }
  for (const std::uint32_t corner : triangle) {
    middle.position += mesh.vertices[corner].position / 3.0;
  }
  middle.seen = 0;
  return middle;
}

bool hasSeenCorner(const Mesh& mesh, const Triangle& triangle) {
  return std::any_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t corner) { return mesh.vertices[corner].seen != 0; });
}

}  // namespace

bool isWideFacet(const Mesh& mesh, std::span<const double> spacing_mm, const Triangle& triangle) {
  double longest_mm = 0.0;
  double apart_mm = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& from = mesh.vertices[triangle[i]].position;
    const Eigen::Vector3d& to = mesh.vertices[triangle[(i + 1) % 3]].position;
    longest_mm = std::max(longest_mm, (to - from).norm());
    apart_mm = std::max(apart_mm, spacing_mm[triangle[i]]);
  }
  return longest_mm > kWideSpacings * apart_mm;
}

void markWideFacets(Mesh& mesh, std::span<const double> spacing_mm) {
  GYRE_CHECK(spacing_mm.size() == mesh.vertices.size());
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle wide = mesh.triangles[i];
    if (!hasSeenCorner(mesh, wide) || !isWideFacet(mesh, spacing_mm, wide)) continue;
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(middleOf(mesh, wide));
    mesh.triangles[i] = {wide[0], wide[1], middle};
    mesh.triangles.push_back({wide[1], wide[2], middle});
    mesh.triangles.push_back({wide[2], wide[0], middle});
  }
}

}  // namespace gyre
