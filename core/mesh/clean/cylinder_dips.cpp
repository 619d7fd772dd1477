// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/cylinder_dips.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/mesh/clean/blend.h"

namespace gyre {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

class DipSplitter {
 public:
  DipSplitter(Mesh& mesh, double radius_mm) : mesh_(mesh), radius_mm_(radius_mm) {}

  void split() {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh_.triangles.size());
    for (const Triangle& corners : mesh_.triangles) splitOne(corners, triangles);
    mesh_.triangles = std::move(triangles);
  }

 private:
  Eigen::Vector2d flat(std::uint32_t vertex) const {
    return mesh_.vertices[vertex].position.head<2>();
  }
  bool isOutside(std::uint32_t vertex) const { return flat(vertex).norm() > radius_mm_; }

  std::uint32_t add(const MeshVertex& vertex) {
    mesh_.vertices.push_back(vertex);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  // The vertex at which the edge comes nearest to the axis, if that is inside and its ends are not.
  std::optional<std::uint32_t> onEdge(std::uint32_t a, std::uint32_t b) {
    if (!isOutside(a) || !isOutside(b)) return std::nullopt;
    const Edge edge(std::min(a, b), std::max(a, b));
    if (const auto known = on_edge_.find(edge); known != on_edge_.end()) return known->second;
    const Eigen::Vector2d along = flat(edge.second) - flat(edge.first);
    const double share = -flat(edge.first).dot(along) / along.squaredNorm();
    if (!(share > 0.0 && share < 1.0)) return std::nullopt;
    if ((flat(edge.first) + share * along).norm() >= radius_mm_) return std::nullopt;
    const MeshVertex nearest = blend(std::array<WeightedVertex, 2>{
        {{&mesh_.vertices[edge.first], 1.0 - share}, {&mesh_.vertices[edge.second], share}}});
    const std::uint32_t vertex = add(nearest);
    on_edge_.emplace(edge, vertex);
    return vertex;
  }

  // Where the axis pierces a triangle whose corners and edges all lie outside.
  std::optional<std::uint32_t> onFace(const Triangle& corners) {
    const std::array<Eigen::Vector2d, 3> at = {flat(corners[0]), flat(corners[1]),
                                               flat(corners[2])};
    const Eigen::Vector3d areas(cross(at[1], at[2]), cross(at[2], at[0]), cross(at[0], at[1]));
    const bool holds_axis = (areas.array() > 0.0).all() || (areas.array() < 0.0).all();
    if (!holds_axis || !std::all_of(corners.begin(), corners.end(),
                                    [&](std::uint32_t vertex) { return isOutside(vertex); })) {
      return std::nullopt;
    }
    const Eigen::Vector3d weights = areas / areas.sum();
    return add(blend(std::array<WeightedVertex, 3>{{{&mesh_.vertices[corners[0]], weights[0]},
                                                    {&mesh_.vertices[corners[1]], weights[1]},
                                                    {&mesh_.vertices[corners[2]], weights[2]}}}));
  }

  // Walks around the triangle; where edges were split it is a polygon of up to six corners, which
  // is cut at the new vertices.
  void splitOne(const Triangle& corners, std::vector<Triangle>& triangles) {
    std::array<std::optional<std::uint32_t>, 3> middle;  // of the edge that begins at the corner
    for (std::size_t i = 0; i < 3; ++i) middle[i] = onEdge(corners[i], corners[(i + 1) % 3]);
    const auto count = std::count_if(middle.begin(), middle.end(),
                                     [](const auto& vertex) { return vertex.has_value(); });
    if (count == 0) {
      const auto centre = onFace(corners);
      if (!centre) {
        triangles.push_back(corners);
        return;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        triangles.push_back({corners[i], corners[(i + 1) % 3], *centre});
      }
      return;
    }
    if (count == 3) {
      for (std::size_t i = 0; i < 3; ++i) {
        triangles.push_back({corners[i], *middle[i], *middle[(i + 2) % 3]});
      }
      triangles.push_back({*middle[0], *middle[1], *middle[2]});
      return;
    }
    // Begin at a split edge whose predecessor is whole: b m ... with a fan from its vertex m.
    std::size_t first = 0;
    while (!middle[first] || middle[(first + 2) % 3]) ++first;
    const std::uint32_t m = *middle[first];
    const std::uint32_t next = corners[(first + 1) % 3];
    const std::uint32_t last = corners[(first + 2) % 3];
    if (const auto second = middle[(first + 1) % 3]) {
      triangles.push_back({m, next, *second});
      triangles.push_back({m, *second, last});
    } else {
      triangles.push_back({m, next, last});
    }
    triangles.push_back({m, last, corners[first]});
  }

  Mesh& mesh_;
  double radius_mm_;
  std::map<Edge, std::uint32_t> on_edge_;
};

}  // namespace

void splitDips(Mesh& mesh, double radius_mm) { DipSplitter(mesh, radius_mm).split(); }

}  // namespace gyre
