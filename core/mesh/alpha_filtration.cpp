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
      joins_mm2_(tetrahedra_.cells()) {
  const auto for_cells = [&](const auto& visit) {
    parallelFor(tetrahedra_.cells(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (auto cell = static_cast<std::uint32_t>(begin); cell < end; ++cell) visit(cell);
    });
  };
  for_cells([&](std::uint32_t cell) {
    cell_radius_mm2_[cell] =
        cellRadius2(tetrahedra_, cell) / unit2(spacing_mm, tetrahedra_.corners[cell]);
  });
  for_cells([&](std::uint32_t cell) { setJoins(cell, spacing_mm); });
}

// For the sides of which the cell is the first of two: each entry is written by one cell.
void AlphaFiltration::setJoins(std::uint32_t cell, std::span<const double> spacing_mm) {
  for (int side = 0; side < 4; ++side) {
    const auto at = static_cast<std::size_t>(side);
    const std::uint32_t next = tetrahedra_.neighbours[cell][at];
    const std::size_t mirror = tetrahedra_.mirrors[cell][at];
    if (next < cell) continue;
    double joins = kNever;
    if (!tetrahedra_.isInfinite(cell, side)) {
      joins = std::min(cell_radius_mm2_[cell], cell_radius_mm2_[next]);
      const Triangle triangle = tetrahedra_.side(cell, side);
      const Ball ball = ballOf(tetrahedra_, triangle);
      const bool alone = !holds(tetrahedra_, triangle, ball, tetrahedra_.corners[cell][at]) &&
                         !holds(tetrahedra_, triangle, ball, tetrahedra_.corners[next][mirror]);
      if (alone) joins = std::min(joins, ball.radius2 / unit2(spacing_mm, triangle));
    }
    joins_mm2_[cell][at] = joins;
    joins_mm2_[next][mirror] = joins;
  }
}

std::vector<double> AlphaFiltration::alphasMm() const {
  std::vector<double> squared;
  const auto add = [&](double alpha_mm2) {
    if (alpha_mm2 < kNever) squared.push_back(alpha_mm2);
  };
  for (std::uint32_t cell = 0; cell < tetrahedra_.cells(); ++cell) {
    add(cell_radius_mm2_[cell]);
    for (const double joins : joins_mm2_[cell]) add(joins);
  }
  std::sort(squared.begin(), squared.end());
  squared.erase(std::unique(squared.begin(), squared.end()), squared.end());
  for (double& alpha : squared) alpha = std::sqrt(alpha);
  return squared;
}

bool AlphaFiltration::isSolid(std::uint32_t cell, double alpha_mm2) const {
  return cell_radius_mm2_[cell] <= alpha_mm2;
}

template <class Visit>
void AlphaFiltration::forBoundary(double alpha_mm2, const Visit& visit) const {
  for (std::uint32_t cell = 0; cell < tetrahedra_.cells(); ++cell) {
    for (std::uint8_t side = 0; side < 4; ++side) {
      const std::uint32_t next = tetrahedra_.neighbours[cell][side];
      if (next < cell || joins_mm2_[cell][side] > alpha_mm2) continue;
      if (isSolid(cell, alpha_mm2) && isSolid(next, alpha_mm2)) continue;
      visit(cell, side, next);
    }
  }
}

AlphaFacet AlphaFiltration::seenFrom(std::uint32_t cell, std::uint8_t side, bool front,
                                     bool back) const {
  // From its own cell's inside the corners run the other way than from beyond it.
  Triangle corners = tetrahedra_.side(cell, side);
  const double radius_mm = std::sqrt(ballOf(tetrahedra_, corners).radius2);
  if (front && !back) std::swap(corners[1], corners[2]);
  return {corners, radius_mm, front && back, cell, side};
}

std::vector<AlphaFacet> AlphaFiltration::boundary(double alpha_mm) const {
  const double alpha_mm2 = alpha_mm * alpha_mm;
  std::vector<AlphaFacet> found;
  forBoundary(alpha_mm2, [&](std::uint32_t cell, std::uint8_t side, std::uint32_t next) {
    found.push_back(seenFrom(cell, side, !isSolid(cell, alpha_mm2), !isSolid(next, alpha_mm2)));
  });
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
      if (reached[next] || isSolid(next, alpha_mm2)) continue;
      if (joins_mm2_[cell][side] <= alpha_mm2) continue;
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
  forBoundary(alpha_mm2, [&](std::uint32_t cell, std::uint8_t side, std::uint32_t next) {
    const bool front = reached[cell] != 0;
    const bool back = reached[next] != 0;
    if (front || back) found.push_back(seenFrom(cell, side, front, back));
  });
  return found;
}

}  // namespace gyre
