// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/tetrahedra.h"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/spatial_sort.h>

namespace gyre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Numbered = std::pair<Kernel::Point_3, std::uint32_t>;
using Sorting =
    CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::First_of_pair_property_map<Numbered>>;

constexpr std::size_t kBatch = 20000;  // points between two looks at the stop request

Error tooFew() {
  return {Error::Code::kTooFew,
          "A surface needs at least four points that do not lie in one plane.",
          "Scan the object from more views, or with more texture on it."};
}

// Inserts in batches along a space-filling curve, so that a stop is heard.
bool insert(Triangulation& triangulation, std::vector<Numbered>& points, const Task& task) {
  CGAL::spatial_sort(points.begin(), points.end(), Sorting());
  Triangulation::Vertex_handle near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kBatch == 0) {
      if (task.stopRequested()) return false;
      task.report(0.9 * static_cast<double>(i) / static_cast<double>(points.size()),
                  "Joining the points");
    }
    const bool first = near == Triangulation::Vertex_handle();
    const auto cell = first ? Triangulation::Cell_handle() : near->cell();
    near = triangulation.insert(points[i].first, cell);
    near->info() = points[i].second;
  }
  return true;
}

void flatten(Triangulation& triangulation, Tetrahedra& flat) {
  triangulation.infinite_vertex()->info() = Tetrahedra::kInfinity;
  std::uint32_t count = 0;
  for (const auto cell : triangulation.all_cell_handles()) cell->info() = count++;
  flat.corners.reserve(count);
  flat.neighbours.reserve(count);
  flat.mirrors.reserve(count);
  for (const auto cell : triangulation.all_cell_handles()) {
    Tetrahedra::Cell corners{};
    Tetrahedra::Cell neighbours{};
    std::array<std::uint8_t, 4> mirrors{};
    for (int i = 0; i < 4; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto next = cell->neighbor(i);
      corners[at] = cell->vertex(i)->info();
      neighbours[at] = next->info();
      mirrors[at] = static_cast<std::uint8_t>(next->index(cell));
    }
    flat.corners.push_back(corners);
    flat.neighbours.push_back(neighbours);
    flat.mirrors.push_back(mirrors);
  }
}

}  // namespace

bool Tetrahedra::isInfinite(std::uint32_t cell) const {
  const Cell& c = corners[cell];
  return c[0] == kInfinity || c[1] == kInfinity || c[2] == kInfinity || c[3] == kInfinity;
}

bool Tetrahedra::isInfinite(std::uint32_t cell, int side) const {
  for (int i = 0; i < 4; ++i) {
    if (i != side && corners[cell][static_cast<std::size_t>(i)] == kInfinity) return true;
  }
  return false;
}

Triangle Tetrahedra::side(std::uint32_t cell, int side) const {
  static constexpr std::array<std::array<std::size_t, 3>, 4> kSides = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const auto& [a, b, c] = kSides[static_cast<std::size_t>(side)];
  const Cell& of = corners[cell];
  return {of[a], of[b], of[c]};
}

Result<Tetrahedra> delaunay(std::vector<Eigen::Vector3d> points, const Task& task) {
  std::vector<Numbered> numbered;
  numbered.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      return Error{Error::Code::kInvalidInput, "The cloud holds a coordinate that is not a number.",
                   "Write the points again with finite coordinates."};
    }
    numbered.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()), i);
  }
  if (numbered.size() < 4) return tooFew();
  try {
    Triangulation triangulation;
    if (!insert(triangulation, numbered, task)) return cancelled();
    if (triangulation.dimension() < 3) return tooFew();
    Tetrahedra flat;
    flat.points = std::move(points);
    flatten(triangulation, flat);
    task.report(1.0, "Joining the points");
    return flat;
  } catch (const std::exception& problem) {
    return Error{Error::Code::kInternal,
                 std::string("The triangulation of the points failed: ") + problem.what() + ".",
                 "Please report this with the points."};
  }
}

CellsAround::CellsAround(const Tetrahedra& tetrahedra) : begin_(tetrahedra.points.size() + 1, 0) {
  const auto for_each_corner = [&](const auto& visit) {
    for (std::uint32_t cell = 0; cell < tetrahedra.cells(); ++cell) {
      for (const std::uint32_t corner : tetrahedra.corners[cell]) {
        if (corner != Tetrahedra::kInfinity) visit(cell, corner);
      }
    }
  };
  for_each_corner([&](std::uint32_t, std::uint32_t corner) { ++begin_[corner + std::size_t{1}]; });
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  cells_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for_each_corner([&](std::uint32_t cell, std::uint32_t corner) { cells_[next[corner]++] = cell; });
}

std::span<const std::uint32_t> CellsAround::of(std::uint32_t point) const {
  return {cells_.data() + begin_[point], begin_[point + std::size_t{1}] - begin_[point]};
}

}  // namespace gyre
