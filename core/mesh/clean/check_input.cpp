// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/check_input.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/edges.h"
#include "core/mesh/vertex_fans.h"

namespace gyre {
namespace {

bool isFinite(const MeshVertex& vertex) {
  return vertex.position.allFinite() && vertex.normal.allFinite() &&
         std::isfinite(vertex.sigma_mm) && vertex.sigma_mm >= 0.0F;
}

bool isProper(const Mesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a == b || b == c || c == a) return false;
  }
  bool proper = true;
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    if (end - begin > 2) proper = false;
    if (end - begin == 2 && begin->forward == (begin + 1)->forward) proper = false;
  });
  if (!proper) return false;
  std::vector<std::uint32_t> vertices = findFans(mesh.triangles).vertex;
  std::sort(vertices.begin(), vertices.end());
  return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end();
}

}  // namespace

Result<void> checkMesh(const Mesh& mesh) {
  if (mesh.triangles.empty()) {
    return Error{Error::Code::kTooFew, "The mesh has no triangles.",
                 "Make a surface of the points first, or crop less."};
  }
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), isFinite)) {
    return Error{Error::Code::kInvalidInput, "The mesh holds a coordinate that is not a number.",
                 "Write the mesh again with finite coordinates."};
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner < mesh.vertices.size()) continue;
      return Error{Error::Code::kInvalidInput,
                   "A triangle of the mesh names a vertex that does not exist.",
                   "Write the mesh again."};
    }
  }
  return {};
}

Result<void> checkSurface(const Mesh& mesh) {
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked;
  if (isProper(mesh)) return {};
  return Error{Error::Code::kInvalidInput,
               "The mesh touches itself, or its triangles disagree about which side is outside.",
               "Separate and orient its surfaces first."};
}

}  // namespace gyre
