// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/curve_underside.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <vector>

#include "core/base/median.h"
#include "core/mesh/clean/blend.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/rim_slopes.h"
#include "core/mesh/clean/underside.h"
#include "core/mesh/clean/underside_patches.h"
#include "core/mesh/clean/unseen_patch.h"
#include "core/mesh/clean/vertex_origins.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

constexpr double kMinShare = 0.03;    // of the diagonal: smaller guesses stay flat
constexpr double kEdgeMedians = 3.0;  // edges of the new triangles, in median edges of the mesh
constexpr double kMaxEdges = 100.0;   // of these along the mesh's diagonal
constexpr int kMaxSpared = 6;         // rounds of leaving out what would cross

double medianEdge_mm(const Mesh& mesh) {
  std::vector<double> lengths;
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto /*end*/) {
    lengths.push_back(
        (mesh.vertices[begin->low].position - mesh.vertices[begin->high].position).norm());
  });
  return median(lengths);
}

// The mesh with what was shaped; all else keeps its numbers.
Mesh shapedMesh(const Mesh& source, const UndersidePatches& patches) {
  auto [mesh, fixed, origins, triangles] = patches.surface();
  Mesh fresh;
  std::vector<std::uint32_t> numbers;  // of these in the mesh
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (fixed[v] != 0 && origins[v] != VertexOrigins::kNone) {
      mesh.vertices[v] = source.vertices[origins[v]];
    } else {
      fresh.vertices.push_back(mesh.vertices[v]);
      numbers.push_back(v);
    }
  }
  carryAttributes(source, fresh);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const MeshVertex& vertex = fresh.vertices[i];
    const bool guessed = fixed[numbers[i]] == 0;
    mesh.vertices[numbers[i]] = guessed ? unseenVertex(vertex.position, vertex.rgb) : vertex;
  }
  divideSeenTriangles(mesh, triangles);
  computeNormals(mesh);
  return mesh;
}

// The patches with even triangles, smaller where these would cross more often than `allowed`.
std::optional<UndersidePatches> evened(const UndersidePatches& divided, std::size_t allowed) {
  UndersidePatches patches = divided;
  for (int round = 0; round < kMaxSpared; ++round) {
    UndersidePatches even = patches;
    even.even();
    const auto crossed = even.crossings();
    const auto spoilt = even.spoilt();
    if (crossed.size() <= allowed && spoilt.empty()) return even;
    patches.spare(crossed);
    patches.spare(spoilt);
  }
  return std::nullopt;
}

CurvedUnderside curved(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                       const Task& task) {
  const double edge_mm =
      std::max(kEdgeMedians * medianEdge_mm(mesh), boundsOf(mesh).diagonal() / kMaxEdges);
  const VertexOrigins origins(mesh);
  UndersidePatches divided(origins, triangles, edge_mm);
  const std::size_t allowed = divided.crossings().size();
  divided.divide();
  auto shaped = evened(divided, allowed);
  if (!shaped || shaped->inner() == 0 || task.stopRequested()) return {mesh};
  const double bent_mm = shaped->bend(RimSlopes(mesh, triangles), allowed, task);
  if (!(bent_mm > 0.0)) return {mesh};
  return {shapedMesh(mesh, *shaped), shaped->inner(), bent_mm};
}

}  // namespace

Result<CurvedUnderside> curveUnderside(const Mesh& mesh, const Task& task) {
  if (const Result<void> checked = checkSurface(mesh); !checked) return checked.error();
  const auto triangles = guessedUnderside(mesh, kMinShare);
  if (triangles.empty()) return CurvedUnderside{mesh};
  task.report(0.0, "Shaping the underside");
  CurvedUnderside shaped;
  try {
    shaped = curved(mesh, triangles, task);
  } catch (const std::exception&) {
    shaped = {mesh};  // the library refused a triangle: flat is not worse than before
  }
  if (task.stopRequested()) return cancelled();
  return shaped;
}

}  // namespace gyre
