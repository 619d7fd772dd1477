// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_facets.h"

#include <cmath>
#include <exception>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace gyre {
namespace {

struct CellState {
  bool solid = false;    // its circumscribed ball is no larger than alpha: part of the body
  bool outside = false;  // the ball from infinity gets here
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellState, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Cell = Delaunay::Cell_handle;

double squaredRadius(const Delaunay& delaunay, const Delaunay::Facet& facet) {
  const auto triangle = delaunay.triangle(facet);
  return CGAL::squared_radius(triangle[0], triangle[1], triangle[2]);
}

// In the alpha complex: a neighbouring cell is solid, or the facet's own smallest ball holds no
// point (Gabriel) and is no larger than alpha.
bool isInComplex(const Delaunay& delaunay, const Delaunay::Facet& facet, double squared_alpha) {
  const Cell behind = facet.first->neighbor(facet.second);
  if (facet.first->info().solid || behind->info().solid) return true;
  return squaredRadius(delaunay, facet) <= squared_alpha && delaunay.is_Gabriel(facet);
}

void markSolid(const Delaunay& delaunay, double squared_alpha) {
  for (const Cell cell : delaunay.finite_cell_handles()) {
    const double squared = CGAL::squared_radius(cell->vertex(0)->point(), cell->vertex(1)->point(),
                                                cell->vertex(2)->point(), cell->vertex(3)->point());
    cell->info().solid = squared <= squared_alpha;  // an overflow of a flat cell is not
  }
}

// Rolls the ball from infinity into every cell that it reaches without crossing the complex.
void markOutside(const Delaunay& delaunay, double squared_alpha) {
  for (const Cell cell : delaunay.all_cell_handles()) cell->info().outside = false;
  const Cell start = delaunay.infinite_cell();
  start->info().outside = true;
  std::vector<Cell> open = {start};
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    for (int side = 0; side < 4; ++side) {
      const Cell next = cell->neighbor(side);
      if (next->info().outside || next->info().solid) continue;
      const Delaunay::Facet facet(cell, side);
      if (!delaunay.is_infinite(facet) && isInComplex(delaunay, facet, squared_alpha)) continue;
      next->info().outside = true;
      open.push_back(next);
    }
  }
}

// The facet's corners, counter-clockwise seen from its own cell.
Triangle cornersFromCell(const Delaunay::Facet& facet) {
  const auto corner = [&](int i) {
    return facet.first->vertex(Delaunay::vertex_triple_index(facet.second, i))->info();
  };
  return {corner(0), corner(1), corner(2)};
}

std::vector<AlphaFacet> collect(const Delaunay& delaunay, double squared_alpha) {
  std::vector<AlphaFacet> facets;
  for (const Delaunay::Facet& facet : delaunay.finite_facets()) {
    const Delaunay::Facet mirror = delaunay.mirror_facet(facet);
    const bool front = facet.first->info().outside;
    const bool back = mirror.first->info().outside;
    if (!front && !back) continue;
    if (!isInComplex(delaunay, facet, squared_alpha)) continue;
    facets.push_back({cornersFromCell(front ? facet : mirror),
                      std::sqrt(squaredRadius(delaunay, facet)), front && back});
  }
  return facets;
}

}  // namespace

Result<std::vector<std::vector<AlphaFacet>>> outerAlphaFacets(
    const std::vector<Eigen::Vector3d>& points, std::span<const double> alphas_mm) {
  try {
    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
    numbered.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      numbered.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()), i);
    }
    const Delaunay delaunay(numbered.begin(), numbered.end());
    if (delaunay.dimension() < 3) {
      return Error{Error::Code::kTooFew,
                   "A surface needs at least four points that do not lie in one plane.",
                   "Scan the object from more views, or with more texture on it."};
    }
    std::vector<std::vector<AlphaFacet>> facets;
    for (const double alpha_mm : alphas_mm) {
      const double squared_alpha = alpha_mm * alpha_mm;
      markSolid(delaunay, squared_alpha);
      markOutside(delaunay, squared_alpha);
      facets.push_back(collect(delaunay, squared_alpha));
    }
    return facets;
  } catch (const std::exception& problem) {
    return Error{Error::Code::kInternal,
                 std::string("The triangulation of the points failed: ") + problem.what() + ".",
                 "Please report this with the points."};
  }
}

}  // namespace gyre
