// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/orient.h"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/split_non_manifold.h"
#include "core/mesh/components.h"
#include "core/mesh/edges.h"
#include "core/mesh/vertex_fans.h"

namespace gyre {
namespace {

struct Neighbour {
  std::uint32_t triangle = 0;
  bool agrees = false;  // both run along the shared edge in opposite directions
};

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

// Turns triangles so that neighbours agree with the first of each piece; tells which were turned.
std::vector<bool> agreeWithNeighbours(Mesh& mesh) {
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    if (end - begin != 2) return;
    const EdgeUse& a = *begin;
    const EdgeUse& b = *(begin + 1);
    neighbours[a.triangle].push_back({b.triangle, a.forward != b.forward});
    neighbours[b.triangle].push_back({a.triangle, a.forward != b.forward});
  });
  std::vector<bool> reached(mesh.triangles.size(), false);
  std::vector<bool> turned(mesh.triangles.size(), false);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < mesh.triangles.size(); ++first) {
    if (reached[first]) continue;
    reached[first] = true;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (const Neighbour& next : neighbours[t]) {
        if (reached[next.triangle]) continue;
        reached[next.triangle] = true;
        turned[next.triangle] = turned[t] == next.agrees;
        open.push_back(next.triangle);
      }
    }
  }
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t]) turn(mesh.triangles[t]);
  }
  return turned;
}

// Cuts where neighbours still run in the same direction, as on a Moebius strip.
void cutOneSided(OrientedMesh& oriented, std::vector<bool>& turned) {
  std::size_t removed = 0;
  do {
    Mesh& mesh = oriented.mesh;
    FanBuilder fans(mesh.triangles);
    forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
      if (end - begin == 2 && begin->forward != (begin + 1)->forward) {
        fans.join(*begin, *(begin + 1));
      }
    });
    oriented.vertices_added += separateFans(mesh, fans.build());
    std::vector<bool> in_the_way(mesh.triangles.size(), false);
    forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
      if (end - begin == 2 && begin->forward == (begin + 1)->forward &&
          !in_the_way[begin->triangle]) {
        in_the_way[(begin + 1)->triangle] = true;
      }
    });
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (in_the_way[t]) continue;
      turned[kept] = turned[t];
      mesh.triangles[kept++] = mesh.triangles[t];
    }
    removed = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    turned.resize(kept);
    oriented.triangles_removed += removed;
  } while (removed > 0);
}

struct Piece {
  std::vector<std::uint32_t> triangles;
  Bounds bounds;
  bool closed = true;
  double volume_mm3 = 0.0;
  double turned_mm2 = 0.0;  // area of triangles that were turned already, minus that of the others
};

std::vector<Piece> findPieces(const Mesh& mesh, const std::vector<bool>& turned) {
  const MeshComponents components = findComponents(mesh);
  std::vector<Piece> pieces(components.area_mm2.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Piece& piece = pieces[components.of_triangle[t]];
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d& first = mesh.vertices[a].position;
    const Eigen::Vector3d& second = mesh.vertices[b].position;
    const Eigen::Vector3d& third = mesh.vertices[c].position;
    piece.triangles.push_back(t);
    for (const Eigen::Vector3d& corner : {first, second, third}) piece.bounds.include(corner);
    piece.volume_mm3 += first.dot(second.cross(third)) / 6.0;
    const double area_mm2 = 0.5 * (second - first).cross(third - first).norm();
    piece.turned_mm2 += turned[t] ? area_mm2 : -area_mm2;
  }
  forEachEdge(edgeUses(mesh.triangles), [&](auto begin, auto end) {
    if (end - begin == 1) pieces[components.of_triangle[begin->triangle]].closed = false;
  });
  return pieces;
}

// Solid angle of a triangle, tan(omega / 2) = a.(b x c) / (abc + (a.b)c + (a.c)b + (b.c)a).
// A. van Oosterom and J. Strackee, "The solid angle of a plane triangle" (1983), eq. 8.
double solidAngle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c) {
  const double below = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + a.dot(c) * b.norm() +
                       b.dot(c) * a.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), below);
}

// The solid angle of a closed piece is 4 pi seen from within, and 0 from outside.
bool isInside(const Mesh& mesh, const Piece& piece, const Eigen::Vector3d& place) {
  if ((place.array() < piece.bounds.min.array()).any() ||
      (place.array() > piece.bounds.max.array()).any()) {
    return false;
  }
  double sum_rad = 0.0;
  for (const std::uint32_t t : piece.triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    sum_rad += solidAngle_rad(mesh.vertices[a].position - place, mesh.vertices[b].position - place,
                              mesh.vertices[c].position - place);
  }
  return std::abs(sum_rad) > kTurn_rad;
}

bool mustTurn(const Mesh& mesh, const std::vector<Piece>& pieces, std::size_t i) {
  const Piece& piece = pieces[i];
  if (!piece.closed) return piece.turned_mm2 > 0.0;
  const Eigen::Vector3d& place = mesh.vertices[mesh.triangles[piece.triangles.front()][0]].position;
  bool hollow = false;
  for (std::size_t other = 0; other < pieces.size(); ++other) {
    if (other != i && pieces[other].closed && isInside(mesh, pieces[other], place)) {
      hollow = !hollow;
    }
  }
  return hollow ? piece.volume_mm3 > 0.0 : piece.volume_mm3 < 0.0;
}

}  // namespace

Result<OrientedMesh> orientOutwards(const Mesh& mesh, const Task& task) {
  if (const Result<void> checked = checkMesh(mesh); !checked) return checked.error();
  OrientedMesh oriented;
  oriented.mesh = mesh;
  std::vector<bool> turned = agreeWithNeighbours(oriented.mesh);
  cutOneSided(oriented, turned);
  removeUnusedVertices(oriented.mesh);
  const std::vector<Piece> pieces = findPieces(oriented.mesh, turned);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (task.stopRequested()) return cancelled();
    if (!mustTurn(oriented.mesh, pieces, i)) continue;
    for (const std::uint32_t t : pieces[i].triangles) {
      turn(oriented.mesh.triangles[t]);
      turned[t] = !turned[t];
    }
  }
  for (const bool was_turned : turned) oriented.triangles_turned += was_turned ? 1 : 0;
  computeNormals(oriented.mesh);
  return oriented;
}

}  // namespace gyre
