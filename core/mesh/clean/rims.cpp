// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/rims.h"

#include <map>

#include "core/mesh/edges.h"

namespace gyre {

std::vector<Rim> findRims(const Mesh& mesh) {
  std::map<std::uint32_t, std::uint32_t> next;  // against the triangle at the edge
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    if (end - begin != 1) return;
    if (begin->forward) {
      next.emplace(begin->high, begin->low);
    } else {
      next.emplace(begin->low, begin->high);
    }
  });
  std::vector<Rim> rims;
  while (!next.empty()) {
    Rim rim;
    for (auto step = next.begin(); step != next.end();) {
      rim.push_back(step->first);
      const std::uint32_t to = step->second;
      next.erase(step);
      step = next.find(to);
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

}  // namespace gyre
