// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/thin_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/base/units.h"

namespace gyre {
namespace {

constexpr std::size_t kNeighbours = 8;

}  // namespace

std::vector<double> localSpacing(const KdTree& points) {
  // k neighbours within the distance d fill a disc of area pi d^2, a square of d^2 pi / k each.
  std::vector<double> spacing(points.size(), 0.0);
  parallelFor(points.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto index = static_cast<std::uint32_t>(i);
      const auto found = points.nearest(points.point(index), kNeighbours + 1);
      const double others = static_cast<double>(found.size() - 1);
      if (others > 0.0) spacing[i] = std::sqrt(found.back().squared_mm2 * kPi / others);
    }
  });
  return spacing;
}

double spacingQuantile(std::span<const double> spacing_mm, double q) {
  std::vector<double> ascending(spacing_mm.begin(), spacing_mm.end());
  std::sort(ascending.begin(), ascending.end());
  double area = 0.0;
  for (const double side : ascending) area += side * side;
  double below = 0.0;
  for (const double side : ascending) {
    below += side * side;
    if (below >= q * area) return side;
  }
  return ascending.empty() ? 0.0 : ascending.back();
}

std::vector<std::uint32_t> thinPoints(const KdTree& points, const ThinningInput& input) {
  GYRE_CHECK(input.cost.size() == points.size() && input.normals.size() == points.size() &&
             input.radius_mm.size() == points.size());
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return input.cost[a] < input.cost[b]; });
  std::vector<char> covered(points.size(), 0);
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t candidate : order) {
    if (covered[candidate]) continue;
    kept.push_back(candidate);
    const Eigen::Vector3d& normal = input.normals[candidate];
    for (const auto& [index, squared_mm2] :
         points.within(points.point(candidate), input.radius_mm[candidate])) {
      if (squared_mm2 == 0.0 || normal.dot(input.normals[index]) >= 0.0) covered[index] = 1;
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace gyre
