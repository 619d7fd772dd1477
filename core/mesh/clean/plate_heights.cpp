// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/plate_heights.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "core/base/check.h"
#include "core/mesh/edges.h"

namespace gyre {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kLeastArea = 1e-3;  // of the squared longest side: thinner triangles count as this

Eigen::Vector2d inPlane(const Plate& plate, std::uint32_t place) {
  return plate.places[place].head<2>();
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The integrals over the triangles: of the gradients' products, and of each place's share of area.
struct Elements {
  std::vector<Eigen::Triplet<double>> stiffness;
  Eigen::VectorXd area;
};

Elements assemble(const Plate& plate) {
  Elements elements;
  elements.area.setZero(static_cast<Eigen::Index>(plate.places.size()));
  elements.stiffness.reserve(9 * plate.triangles.size());
  for (const Triangle& triangle : plate.triangles) {
    std::array<Eigen::Vector2d, 3> opposite;
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      opposite[i] = inPlane(plate, triangle[(i + 2) % 3]) - inPlane(plate, triangle[(i + 1) % 3]);
      longest = std::max(longest, opposite[i].squaredNorm());
    }
    const double area =
        std::max(0.5 * std::abs(cross(opposite[0], opposite[1])), kLeastArea * longest);
    for (std::size_t i = 0; i < 3; ++i) {
      elements.area[triangle[i]] += area / 3.0;
      for (std::size_t k = 0; k < 3; ++k) {
        elements.stiffness.emplace_back(triangle[i], triangle[k],
                                        opposite[i].dot(opposite[k]) / (4.0 * area));
      }
    }
  }
  return elements;
}

// What flows out over the rim near each place, and whether that is known.
struct RimFlow {
  Eigen::VectorXd flow;
  std::vector<char> known;
};

RimFlow rimFlow(const Plate& plate) {
  RimFlow rim{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(plate.places.size())),
              std::vector<char>(plate.places.size(), 1)};
  forEachEdge(edgeUses(plate.triangles), [&](auto begin, auto end) {
    if (end - begin != 1) return;
    const auto& slope = plate.slopes[begin->low];
    const auto& other = plate.slopes[begin->high];
    if (!slope && !other) {
      rim.known[begin->low] = rim.known[begin->high] = 0;
      return;
    }
    const Eigen::Vector2d mean =
        0.5 * (slope.value_or(*(other ? other : slope)) + other.value_or(*(slope ? slope : other)));
    const Eigen::Vector2d from = inPlane(plate, begin->low);
    const Eigen::Vector2d along = inPlane(plate, begin->high) - from;
    Eigen::Vector2d outward(along.y(), -along.x());  // as long as the edge
    for (const std::uint32_t corner : plate.triangles[begin->triangle]) {
      if (outward.dot(inPlane(plate, corner) - from) > 1e-9 * along.squaredNorm()) {
        outward = -outward;
        break;
      }
    }
    rim.flow[begin->low] += 0.5 * mean.dot(outward);
    rim.flow[begin->high] += 0.5 * mean.dot(outward);
  });
  return rim;
}

}  // namespace

std::optional<std::vector<double>> plateHeights(const Plate& plate) {
  const std::size_t count = plate.places.size();
  GYRE_CHECK(plate.held.size() == count && plate.slopes.size() == count);
  const Elements elements = assemble(plate);
  const RimFlow rim = rimFlow(plate);
  std::vector<Eigen::Index> column(count, -1);
  Eigen::Index unknowns = 0;
  Eigen::VectorXd heights(static_cast<Eigen::Index>(count));
  Eigen::VectorXd weights(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    heights[row] = plate.held[i] != 0 ? plate.places[i].z() : 0.0;
    weights[row] = rim.known[i] != 0 && elements.area[row] > 0.0 ? 1.0 / elements.area[row] : 0.0;
    if (plate.held[i] == 0) column[i] = unknowns++;
  }
  std::vector<Eigen::Triplet<double>> picked;
  for (std::size_t i = 0; i < count; ++i) {
    if (column[i] >= 0) picked.emplace_back(static_cast<Eigen::Index>(i), column[i], 1.0);
  }
  const auto rows = static_cast<Eigen::Index>(count);
  Sparse stiffness(rows, rows);
  stiffness.setFromTriplets(elements.stiffness.begin(), elements.stiffness.end());
  Sparse pick(rows, unknowns);
  pick.setFromTriplets(picked.begin(), picked.end());
  const Sparse free = stiffness * pick;
  const Sparse weighted = weights.asDiagonal() * free;
  const Sparse normal = Sparse(free.transpose()) * weighted;
  const Eigen::VectorXd asked = rim.flow - stiffness * heights;
  const Eigen::SimplicialLDLT<Sparse> solver(normal);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd solved = solver.solve(weighted.transpose() * asked);
  if (solver.info() != Eigen::Success || !solved.allFinite()) return std::nullopt;
  heights += pick * solved;
  return std::vector<double>(heights.begin(), heights.end());
}

}  // namespace gyre
