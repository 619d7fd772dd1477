// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_filtration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace gyre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNoFacet = std::numeric_limits<std::uint32_t>::max();

Kernel::Point_3 placeOf(const Tetrahedra& tetrahedra, std::uint32_t point) {
  const Eigen::Vector3d& place = tetrahedra.points[point];
  return {place.x(), place.y(), place.z()};
}

double cellRadius2(const Tetrahedra& tetrahedra, std::uint32_t cell) {
  if (tetrahedra.isInfinite(cell)) return kNever;
  const auto& [a, b, c, d] = tetrahedra.corners[cell];
  const double radius2 = CGAL::squared_radius(placeOf(tetrahedra, a), placeOf(tetrahedra, b),
                                              placeOf(tetrahedra, c), placeOf(tetrahedra, d));
  return std::isnan(radius2) ? kNever : radius2;  // a cell as flat as numbers can tell
}

// Whether the smallest ball through the triangle holds neither of the points beside it.
bool isGabriel(const Tetrahedra& tetrahedra, const Triangle& triangle, std::uint32_t apex,
               std::uint32_t mirror_apex) {
  const auto holds = [&](std::uint32_t point) {
    return point != Tetrahedra::kInfinity &&
           CGAL::side_of_bounded_sphere(placeOf(tetrahedra, triangle[0]),
                                        placeOf(tetrahedra, triangle[1]),
                                        placeOf(tetrahedra, triangle[2]),
                                        placeOf(tetrahedra, point)) == CGAL::ON_BOUNDED_SIDE;
  };
  return !holds(apex) && !holds(mirror_apex);
}

// Square of the mean spacing at the corners; 1 where no spacing is given.
template <std::size_t N>
double unit2(std::span<const double> spacing_mm, const std::array<std::uint32_t, N>& corners) {
  if (spacing_mm.empty()) return 1.0;
  double sum = 0.0;
  for (const std::uint32_t corner : corners) {
    if (corner != Tetrahedra::kInfinity) sum += spacing_mm[corner];
  }
  const double mean = sum / static_cast<double>(N);
  return mean * mean;
}

}  // namespace

AlphaFiltration::AlphaFiltration(Tetrahedra tetrahedra, std::span<const double> spacing_mm)
    : tetrahedra_(std::move(tetrahedra)), facet_of_side_(tetrahedra_.cells()) {
  const auto cells = static_cast<std::uint32_t>(tetrahedra_.cells());
  cell_radius_mm2_.reserve(cells);
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    cell_radius_mm2_.push_back(cellRadius2(tetrahedra_, cell) /
                               unit2(spacing_mm, tetrahedra_.corners[cell]));
    facet_of_side_[cell].fill(kNoFacet);
  }
  facets_.reserve(2 * tetrahedra_.cells());
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    for (std::uint8_t side = 0; side < 4; ++side) {
      const std::uint32_t next = tetrahedra_.neighbours[cell][side];
      const std::uint32_t mirror = tetrahedra_.mirrors[cell][side];
      if (next < cell || tetrahedra_.isInfinite(cell, side)) continue;
      const Triangle triangle = tetrahedra_.side(cell, side);
      const auto& [a, b, c] = triangle;
      Facet facet{cell, side, 0.0, 0.0, 0.0};
      facet.radius_mm2 = CGAL::squared_radius(placeOf(tetrahedra_, a), placeOf(tetrahedra_, b),
                                              placeOf(tetrahedra_, c)) /
                         unit2(spacing_mm, triangle);
      const auto [smaller, larger] = std::minmax(cell_radius_mm2_[cell], cell_radius_mm2_[next]);
      const bool alone = isGabriel(tetrahedra_, triangle, tetrahedra_.corners[cell][side],
                                   tetrahedra_.corners[next][mirror]);
      facet.joins_mm2 = alone ? std::min(facet.radius_mm2, smaller) : smaller;
      facet.leaves_mm2 = larger;
      const auto number = static_cast<std::uint32_t>(facets_.size());
      facet_of_side_[cell][side] = number;
      facet_of_side_[next][mirror] = number;
      facets_.push_back(facet);
    }
  }
}

std::vector<double> AlphaFiltration::alphasMm() const {
  std::vector<double> squared;
  squared.reserve(2 * facets_.size());
  for (const Facet& facet : facets_) {
    squared.push_back(facet.joins_mm2);
    if (facet.leaves_mm2 < kNever) squared.push_back(facet.leaves_mm2);
  }
  std::sort(squared.begin(), squared.end());
  squared.erase(std::unique(squared.begin(), squared.end()), squared.end());
  for (double& alpha : squared) alpha = std::sqrt(alpha);
  return squared;
}

bool AlphaFiltration::isSolid(std::uint32_t cell, double alpha_mm2) const {
  return cell_radius_mm2_[cell] <= alpha_mm2;
}

AlphaFacet AlphaFiltration::seenFrom(const Facet& facet, bool front, bool back) const {
  // From its own cell's inside the corners run the other way than from beyond it.
  Triangle corners = tetrahedra_.side(facet.cell, facet.side);
  if (front && !back) std::swap(corners[1], corners[2]);
  return {corners, std::sqrt(facet.radius_mm2), front && back, facet.cell, facet.side};
}

std::vector<AlphaFacet> AlphaFiltration::boundary(double alpha_mm) const {
  const double alpha_mm2 = alpha_mm * alpha_mm;
  std::vector<AlphaFacet> found;
  for (const Facet& facet : facets_) {
    if (facet.joins_mm2 > alpha_mm2 || facet.leaves_mm2 <= alpha_mm2) continue;
    const std::uint32_t next = tetrahedra_.neighbours[facet.cell][facet.side];
    found.push_back(seenFrom(facet, !isSolid(facet.cell, alpha_mm2), !isSolid(next, alpha_mm2)));
  }
  return found;
}

std::vector<char> AlphaFiltration::reachedFromInfinity(double alpha_mm2) const {
  std::vector<char> reached(tetrahedra_.cells(), 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t cell = 0; cell < reached.size(); ++cell) {
    if (!tetrahedra_.isInfinite(cell)) continue;
    reached[cell] = 1;
    open.push_back(cell);
  }
  while (!open.empty()) {
    const std::uint32_t cell = open.back();
    open.pop_back();
    for (std::size_t side = 0; side < 4; ++side) {
      const std::uint32_t next = tetrahedra_.neighbours[cell][side];
      const std::uint32_t facet = facet_of_side_[cell][side];
      if (reached[next] || isSolid(next, alpha_mm2)) continue;
      if (facet != kNoFacet && facets_[facet].joins_mm2 <= alpha_mm2) continue;
      reached[next] = 1;
      open.push_back(next);
    }
  }
  return reached;
}

std::vector<AlphaFacet> AlphaFiltration::outerBoundary(double alpha_mm) const {
  const double alpha_mm2 = alpha_mm * alpha_mm;
  const std::vector<char> reached = reachedFromInfinity(alpha_mm2);
  std::vector<AlphaFacet> found;
  for (const Facet& facet : facets_) {
    if (facet.joins_mm2 > alpha_mm2 || facet.leaves_mm2 <= alpha_mm2) continue;
    const bool front = reached[facet.cell] != 0;
    const bool back = reached[tetrahedra_.neighbours[facet.cell][facet.side]] != 0;
    if (front || back) found.push_back(seenFrom(facet, front, back));
  }
  return found;
}

}  // namespace gyre
