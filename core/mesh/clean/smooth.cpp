// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/smooth.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

constexpr double kLambda = 0.5;
constexpr double kMu = -0.53;
constexpr std::size_t kGrain = 4096;

using Positions = std::vector<Eigen::Vector3d>;

// The neighbours of each vertex: those of vertex v lie in [begin[v], begin[v + 1]).
struct Neighbourhoods {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> neighbours;
  double mean_edge_mm = 0.0;
};

Neighbourhoods findNeighbours(const Mesh& mesh) {
  struct Link {
    std::uint32_t from;
    std::uint32_t to;
  };
  std::vector<Link> links;
  std::vector<bool> on_rim(mesh.vertices.size(), false);
  const std::vector<EdgeUse> uses = edgeUses(mesh.triangles);
  forEachEdge(uses, [&](auto begin, auto end) {
    if (end - begin == 1) on_rim[begin->low] = on_rim[begin->high] = true;
  });
  Neighbourhoods found;
  std::size_t edges = 0;
  forEachEdge(uses, [&](auto begin, auto end) {
    const bool is_rim = end - begin == 1;
    ++edges;
    found.mean_edge_mm +=
        (mesh.vertices[begin->low].position - mesh.vertices[begin->high].position).norm();
    if (is_rim || !on_rim[begin->low]) links.push_back({begin->low, begin->high});
    if (is_rim || !on_rim[begin->high]) links.push_back({begin->high, begin->low});
  });
  found.mean_edge_mm /= static_cast<double>(edges);
  found.begin.assign(mesh.vertices.size() + 1, 0);
  for (const Link& link : links) ++found.begin[link.from + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) found.begin[v + 1] += found.begin[v];
  std::vector<std::uint32_t> next(found.begin.begin(), found.begin.end() - 1);
  found.neighbours.resize(links.size());
  for (const Link& link : links) found.neighbours[next[link.from]++] = link.to;
  return found;
}

// x' = x + s * (mean of the neighbours - x)
void stroke(const Neighbourhoods& around, double s, const Positions& from, Positions& to) {
  parallelFor(from.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      to[v] = from[v];
      const std::uint32_t first = around.begin[v];
      const std::uint32_t last = around.begin[v + 1];
      if (first == last) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::uint32_t i = first; i < last; ++i) sum += from[around.neighbours[i]];
      to[v] += s * (sum / static_cast<double>(last - first) - from[v]);
    }
  });
}

std::vector<double> boundsOfMoves(const Mesh& mesh, const SmoothOptions& options,
                                  double mean_edge_mm) {
  std::vector<double> bounds_mm;
  bounds_mm.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    const bool measured = vertex.seen != 0 && vertex.sigma_mm > 0.0F;
    bounds_mm.push_back(measured ? options.max_sigmas * static_cast<double>(vertex.sigma_mm)
                                 : options.max_edge_share * mean_edge_mm);
  }
  return bounds_mm;
}

// Brings every vertex back to within its bound of where it started, and to the height it holds.
void holdBack(const Mesh& start, const std::vector<double>& bounds_mm, double hold_z_mm,
              Positions& at) {
  for (std::size_t v = 0; v < at.size(); ++v) {
    const Eigen::Vector3d& origin = start.vertices[v].position;
    if (origin.z() == hold_z_mm) at[v].z() = hold_z_mm;
    const Eigen::Vector3d move = at[v] - origin;
    const double length_mm = move.norm();
    if (length_mm > bounds_mm[v]) at[v] = origin + move * (bounds_mm[v] / length_mm);
  }
}

}  // namespace

Result<SmoothedMesh> smoothMesh(const Mesh& mesh, const SmoothOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  SmoothedMesh smoothed;
  smoothed.mesh = mesh;
  if (options.iterations == 0) return smoothed;
  const Neighbourhoods around = findNeighbours(mesh);
  const std::vector<double> bounds_mm = boundsOfMoves(mesh, options, around.mean_edge_mm);
  Positions at;
  at.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) at.push_back(vertex.position);
  Positions between(at.size());
  for (int i = 0; i < options.iterations; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / options.iterations, "Smoothing");
    stroke(around, kLambda, at, between);
    stroke(around, kMu, between, at);
    holdBack(mesh, bounds_mm, options.hold_z_mm, at);
  }
  std::vector<double> moves_mm;
  moves_mm.reserve(at.size());
  std::size_t at_bound = 0;
  for (std::size_t v = 0; v < at.size(); ++v) {
    smoothed.mesh.vertices[v].position = at[v];
    moves_mm.push_back((at[v] - mesh.vertices[v].position).norm());
    if (moves_mm.back() >= 0.999 * bounds_mm[v]) ++at_bound;
  }
  smoothed.largest_move_mm = *std::max_element(moves_mm.begin(), moves_mm.end());
  smoothed.median_move_mm = median(moves_mm);
  smoothed.at_bound_share = static_cast<double>(at_bound) / static_cast<double>(at.size());
  computeNormals(smoothed.mesh);
  return smoothed;
}

}  // namespace gyre
