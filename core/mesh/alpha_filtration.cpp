// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/alpha_filtration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Geometry>

#include "core/base/parallel.h"

namespace gyre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::size_t kGrain = 4096;
constexpr double kCertain = 1e-6;  // of the squared radius; rounding stays far below
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

// The smallest ball through a triangle.
struct Ball {
  Eigen::Vector3d centre;
  double radius2 = 0.0;
};

Ball ballOf(const Tetrahedra& tetrahedra, const Triangle& triangle) {
  const Eigen::Vector3d& origin = tetrahedra.points[triangle[0]];
  const Eigen::Vector3d b = tetrahedra.points[triangle[1]] - origin;
  const Eigen::Vector3d c = tetrahedra.points[triangle[2]] - origin;
  const Eigen::Vector3d normal = b.cross(c);
  const Eigen::Vector3d to_centre =
      (b.squaredNorm() * c.cross(normal) + c.squaredNorm() * normal.cross(b)) /
      (2.0 * normal.squaredNorm());
  return {origin + to_centre, to_centre.squaredNorm()};
}

// Whether the ball holds the point in its inside: by numbers where these are certain, else exactly.
bool holds(const Tetrahedra& tetrahedra, const Triangle& triangle, const Ball& ball,
           std::uint32_t point) {
  if (point == Tetrahedra::kInfinity) return false;
  const double margin = (tetrahedra.points[point] - ball.centre).squaredNorm() / ball.radius2 - 1.0;
  if (std::abs(margin) > kCertain) return margin < 0.0;  // false for a triangle without area
  return CGAL::side_of_bounded_sphere(
             placeOf(tetrahedra, triangle[0]), placeOf(tetrahedra, triangle[1]),
             placeOf(tetrahedra, triangle[2]), placeOf(tetrahedra, point)) == CGAL::ON_BOUNDED_SIDE;
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
    : tetrahedra_(std::move(tetrahedra)),
      cell_radius_mm2_(tetrahedra_.cells()),
      facet_of_side_(tetrahedra_.cells()) {
  listFacets();
  parallelFor(tetrahedra_.cells(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto cell = static_cast<std::uint32_t>(begin); cell < end; ++cell) {
      cell_radius_mm2_[cell] =
          cellRadius2(tetrahedra_, cell) / unit2(spacing_mm, tetrahedra_.corners[cell]);
    }
  });
  parallelFor(facets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) setInterval(facets_[i], spacing_mm);
  });
}

void AlphaFiltration::listFacets() {
  facets_.reserve(2 * tetrahedra_.cells());
  for (std::uint32_t cell = 0; cell < tetrahedra_.cells(); ++cell) {
    for (std::uint8_t side = 0; side < 4; ++side) {
      const std::uint32_t next = tetrahedra_.neighbours[cell][side];
      if (next < cell) continue;
      const bool reaches_infinity = tetrahedra_.isInfinite(cell, side);
      const auto number = reaches_infinity ? kNoFacet : static_cast<std::uint32_t>(facets_.size());
      facet_of_side_[cell][side] = number;
      facet_of_side_[next][tetrahedra_.mirrors[cell][side]] = number;
      if (!reaches_infinity) facets_.push_back({cell, side, 0.0, 0.0, 0.0});
    }
  }
}

void AlphaFiltration::setInterval(Facet& facet, std::span<const double> spacing_mm) const {
  const std::uint32_t next = tetrahedra_.neighbours[facet.cell][facet.side];
  const std::uint32_t mirror = tetrahedra_.mirrors[facet.cell][facet.side];
  const Triangle triangle = tetrahedra_.side(facet.cell, facet.side);
  const Ball ball = ballOf(tetrahedra_, triangle);
  facet.radius_mm2 = ball.radius2 / unit2(spacing_mm, triangle);
  const auto [smaller, larger] = std::minmax(cell_radius_mm2_[facet.cell], cell_radius_mm2_[next]);
  const bool alone =
      !holds(tetrahedra_, triangle, ball, tetrahedra_.corners[facet.cell][facet.side]) &&
      !holds(tetrahedra_, triangle, ball, tetrahedra_.corners[next][mirror]);
  facet.joins_mm2 = alone ? std::min(facet.radius_mm2, smaller) : smaller;
  facet.leaves_mm2 = larger;
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
