// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/vertex_fans.h"

#include <limits>

namespace gyre {
namespace {

std::uint32_t cornerAt(const std::vector<Triangle>& triangles, std::uint32_t triangle,
                       std::uint32_t vertex) {
  const Triangle& corners = triangles[triangle];
  const std::uint32_t place = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
  return 3 * triangle + place;
}

}  // namespace

std::uint32_t VertexFans::at(const std::vector<Triangle>& triangles, std::uint32_t triangle,
                             std::uint32_t of_vertex) const {
  return of_corner[cornerAt(triangles, triangle, of_vertex)];
}

FanBuilder::FanBuilder(const std::vector<Triangle>& triangles)
    : triangles_(triangles), corners_(3 * triangles.size()) {}

void FanBuilder::join(const EdgeUse& a, const EdgeUse& b) {
  for (const std::uint32_t vertex : {a.low, a.high}) {
    corners_.join(cornerAt(triangles_, a.triangle, vertex),
                  cornerAt(triangles_, b.triangle, vertex));
  }
}

VertexFans FanBuilder::build() {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  VertexFans fans;
  fans.of_corner.resize(3 * triangles_.size());
  std::vector<std::uint32_t> number(fans.of_corner.size(), kNone);
  for (std::uint32_t corner = 0; corner < fans.of_corner.size(); ++corner) {
    std::uint32_t& fan = number[corners_.find(corner)];
    if (fan == kNone) {
      fan = static_cast<std::uint32_t>(fans.vertex.size());
      fans.vertex.push_back(triangles_[corner / 3][corner % 3]);
    }
    fans.of_corner[corner] = fan;
  }
  return fans;
}

VertexFans findFans(const std::vector<Triangle>& triangles) {
  FanBuilder builder(triangles);
  forEachEdge(edgeUses(triangles), [&](auto begin, auto end) {
    for (auto use = begin + 1; use != end; ++use) builder.join(*begin, *use);
  });
  return builder.build();
}

}  // namespace gyre
