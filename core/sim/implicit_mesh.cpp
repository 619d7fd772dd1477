// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/implicit_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"

namespace gyre {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffffU;
constexpr DistanceStretch kStretch = {.outside = kMostStretchOutside, .inside = kMostStretchInside};

// The mean of the points where the cell's edges cross zero, or nothing when none does.
std::optional<Eigen::Vector3d> cellVertex(const DistanceLattice& lattice,
                                          const Eigen::Array3i& cell) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int crossings = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Eigen::Array3i a = cell;
      a[(axis + 1) % 3] += corner & 1;
      a[(axis + 2) % 3] += corner >> 1;
      Eigen::Array3i b = a;
      b[axis] += 1;
      const double at_a = lattice.values[lattice.index(a)];
      const double at_b = lattice.values[lattice.index(b)];
      if ((at_a < 0.0) == (at_b < 0.0)) continue;
      sum += lattice.at(a) + (at_a / (at_a - at_b)) * (lattice.at(b) - lattice.at(a));
      ++crossings;
    }
  }
  if (crossings == 0) return std::nullopt;
  return sum / crossings;
}

template <class Visit>
void forEachPoint(const Eigen::Array3i& from, const Eigen::Array3i& to, const Visit& visit) {
  for (int z = from.z(); z < to.z(); ++z)
    for (int y = from.y(); y < to.y(); ++y)
      for (int x = from.x(); x < to.x(); ++x) visit(Eigen::Array3i(x, y, z));
}

void addQuad(Mesh& mesh, const std::array<std::uint32_t, 4>& corner) {
  const auto length = [&](int a, int b) {
    return (mesh.vertices[corner[static_cast<std::size_t>(a)]].position -
            mesh.vertices[corner[static_cast<std::size_t>(b)]].position)
        .squaredNorm();
  };
  if (length(0, 2) <= length(1, 3)) {
    mesh.triangles.push_back({corner[0], corner[1], corner[2]});
    mesh.triangles.push_back({corner[0], corner[2], corner[3]});
  } else {
    mesh.triangles.push_back({corner[1], corner[2], corner[3]});
    mesh.triangles.push_back({corner[1], corner[3], corner[0]});
  }
}

// Every lattice edge that crosses the surface is circled by four cells: their vertices are a quad.
void addQuads(const DistanceLattice& lattice, const std::vector<std::uint32_t>& vertex_of_cell,
              Mesh& mesh) {
  forEachPoint(Eigen::Array3i::Ones(), lattice.size - 1, [&](const Eigen::Array3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Array3i next = p;
      next[axis] += 1;
      const bool inside = lattice.inside(p);
      if (inside == lattice.inside(next)) continue;
      Eigen::Array3i b = Eigen::Array3i::Zero();
      Eigen::Array3i c = Eigen::Array3i::Zero();
      b[(axis + 1) % 3] = 1;
      c[(axis + 2) % 3] = 1;
      std::array<std::uint32_t, 4> quad = {
          vertex_of_cell[lattice.index(p)], vertex_of_cell[lattice.index(p - b)],
          vertex_of_cell[lattice.index(p - b - c)], vertex_of_cell[lattice.index(p - c)]};
      if (!inside) std::reverse(quad.begin(), quad.end());
      addQuad(mesh, quad);
    }
  });
}

Eigen::Vector3d broughtToZero(const SignedDistance& distance, Eigen::Vector3d p, double cell_mm) {
  const double h = 1e-4 * cell_mm;
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Vector3d slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
      slope[axis] = (distance(p + step) - distance(p - step)) / (2.0 * h);
    }
    const double value = distance(p);
    Eigen::Vector3d move = -value * slope / std::max(slope.squaredNorm(), 0.1);
    const double longest = 0.5 * cell_mm;
    if (move.norm() > longest) move *= longest / move.norm();
    p += move;
    if (std::abs(value) < 1e-4 * cell_mm) break;
  }
  return p;
}

}  // namespace

Mesh meshOfImplicit(const SignedDistance& distance, const Bounds& box, double cell_mm) {
  const DistanceLattice lattice = sampleDistance(distance, {box.min, box.max}, cell_mm, kStretch);
  Mesh mesh;
  std::vector<std::uint32_t> vertex_of_cell(lattice.values.size(), kNoVertex);
  forEachPoint(Eigen::Array3i::Zero(), lattice.size - 1, [&](const Eigen::Array3i& cell) {
    const std::size_t here = lattice.index(cell);
    if (std::abs(lattice.values[here]) > 4.0F * static_cast<float>(cell_mm)) return;
    const auto position = cellVertex(lattice, cell);
    if (!position) return;
    vertex_of_cell[here] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back().position = *position;
  });
  addQuads(lattice, vertex_of_cell, mesh);
  parallelFor(mesh.vertices.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector3d& position = mesh.vertices[i].position;
      position = broughtToZero(distance, position, cell_mm);
    }
  });
  computeNormals(mesh);
  return mesh;
}

}  // namespace gyre
