// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/corner_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <Eigen/Dense>

#include "core/base/check.h"
#include "core/base/units.h"
#include "core/calib/corners/corner_index.h"
#include "core/calib/corners/plane_homography.h"

namespace gyre {
namespace {

constexpr double kCone_rad = radFromDeg(18.0);      // about an edge, in which its next corner is
constexpr double kEdgeTurn_rad = radFromDeg(14.0);  // of an edge against the lattice there
constexpr double kLeastStep_px = 3.0;
constexpr int kWindow = 2;       // cells whose homography predicts one
constexpr int kMostCells = 200;  // a side

// Row by row, as the nodes of a lattice are.
struct RowByRow {
  bool operator()(const Eigen::Vector2i& a, const Eigen::Vector2i& b) const {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  }
};
using Cells = std::map<Eigen::Vector2i, int, RowByRow>;

double angleBetweenLines(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), std::abs(a.dot(b)));
}

// Whether the corner's edges run along both directions, one each, and which squares are dark: +1
// when those along column + row are bright, -1 when they are dark, 0 when the edges do not fit.
int polarityAlong(const XCorner& corner, const Eigen::Vector2d& column, const Eigen::Vector2d& row,
                  double most_rad) {
  const double straight =
      std::max(angleBetweenLines(corner.edge_a, column), angleBetweenLines(corner.edge_b, row));
  const double crossed =
      std::max(angleBetweenLines(corner.edge_a, row), angleBetweenLines(corner.edge_b, column));
  if (std::min(straight, crossed) > most_rad) return 0;
  const Eigen::Vector2d& along_column = straight < crossed ? corner.edge_a : corner.edge_b;
  const Eigen::Vector2d& along_row = straight < crossed ? corner.edge_b : corner.edge_a;
  // The bright squares lie along +-(edge_a + edge_b), whichever way each edge points.
  return along_column.dot(column) * along_row.dot(row) > 0.0 ? 1 : -1;
}

class Grower {
 public:
  Grower(std::span<const XCorner> corners, const CornerIndex& index, double snap)
      : corners_(corners), index_(index), snap_(snap) {}

  // The lattice about the seed among corners that are free, or an empty one.
  Cells grow(int seed, const std::vector<bool>& used) {
    used_ = &used;
    for (const double sign : {1.0, -1.0}) {
      if (plant(seed, sign)) {
        while (growOnce()) {
        }
        prune();
        return cells_;
      }
    }
    return {};
  }

  int polarity() const { return polarity_; }  // at cell (0, 0), see polarityAlong()

 private:
  const XCorner& cornerAt(int i) const { return corners_[static_cast<std::size_t>(i)]; }
  bool isFree(int i) const { return !(*used_)[static_cast<std::size_t>(i)] && !taken_.contains(i); }

  // The next corner along a direction. -1 when its edges and dark squares do not continue those of
  // the first: something lies between, or another plane, and other seeds are better.
  int next(int from, const Eigen::Vector2d& along, const Eigen::Vector2d& across) const {
    const XCorner& start = cornerAt(from);
    const int polarity = polarityAlong(start, along, across, kEdgeTurn_rad);
    for (const int i : index_.nearest(start.pixel, 24)) {
      const Eigen::Vector2d step = cornerAt(i).pixel - start.pixel;
      if (i == from || step.norm() < kLeastStep_px) continue;
      const double cross = step.x() * along.y() - step.y() * along.x();
      if (std::atan2(std::abs(cross), step.dot(along)) > kCone_rad) continue;
      // Perspective turns the crossing edge more than the one along which we go.
      const bool continues =
          isFree(i) && polarityAlong(cornerAt(i), step, across, 2.0 * kEdgeTurn_rad) == -polarity;
      return continues ? i : -1;
    }
    return -1;
  }

  // Lays the first square; tries the two squares on either side of the seed's first edge.
  bool plant(int seed, double sign) {
    cells_.clear();
    taken_.clear();
    const XCorner& first = cornerAt(seed);
    Eigen::Vector2d column = sign * first.edge_a;
    Eigen::Vector2d row = first.edge_b;
    if (column.x() * row.y() - column.y() * row.x() < 0.0) row = -row;
    polarity_ = polarityAlong(first, column, row, kEdgeTurn_rad);
    const int right = next(seed, column, row);
    const int below = next(seed, row, column);
    if (right < 0 || below < 0 || right == below) return false;
    column = cornerAt(right).pixel - first.pixel;
    row = cornerAt(below).pixel - first.pixel;
    const double ratio = column.norm() / row.norm();
    if (ratio > 6.0 || ratio < 1.0 / 6.0) return false;
    const Eigen::Vector2d diagonal = first.pixel + column + row;
    const int last = index_.nearestWithin(diagonal, 0.35 * std::min(column.norm(), row.norm()));
    if (last < 0 || !isFree(last) || last == seed || last == right || last == below) return false;
    if (polarityAlong(cornerAt(last), column, row, 2.0 * kEdgeTurn_rad) != polarity_) return false;
    take({0, 0}, seed);
    take({1, 0}, right);
    take({0, 1}, below);
    take({1, 1}, last);
    return true;
  }

  void take(const Eigen::Vector2i& cell, int corner) {
    cells_[cell] = corner;
    taken_.insert(corner);
  }

  std::vector<PlaneSighting> around(const Eigen::Vector2i& cell) const {
    std::vector<PlaneSighting> known;
    for (int dy = -kWindow; dy <= kWindow; ++dy) {
      for (int dx = -kWindow; dx <= kWindow; ++dx) {
        const auto found = cells_.find(cell + Eigen::Vector2i(dx, dy));
        if (found == cells_.end() || (dx == 0 && dy == 0)) continue;
        known.push_back({found->first.cast<double>(), cornerAt(found->second).pixel,
                         1.0 / std::max({1, std::abs(dx), std::abs(dy)})});
      }
    }
    return known;
  }

  // The free corner that fits the cell, or -1.
  int fitting(const Eigen::Vector2i& cell, const std::vector<PlaneSighting>& known) const {
    const auto homography = fitHomography(known);
    if (!homography) return -1;
    const Eigen::Vector2d place = cell.cast<double>();
    if ((*homography * place.homogeneous()).z() <= 0.0) return -1;
    const Eigen::Matrix2d jacobian = homographyJacobian(*homography, place);
    const Eigen::Vector2d predicted = throughHomography(*homography, place);
    const int found = index_.nearestWithin(predicted, snap_ * leastStretch(jacobian));
    if (found < 0 || !isFree(found)) return -1;
    const int expected = ((cell.x() + cell.y()) & 1) != 0 ? -polarity_ : polarity_;
    const bool fits =
        polarityAlong(cornerAt(found), jacobian.col(0), jacobian.col(1), kEdgeTurn_rad) == expected;
    return fits ? found : -1;
  }

  // One round over the cells next to those that are taken, the best founded first.
  bool growOnce() {
    std::map<Eigen::Vector2i, std::size_t, RowByRow> support;
    for (const auto& [cell, corner] : cells_) {
      if (cell.cwiseAbs().maxCoeff() > kMostCells) continue;
      for (int step = 1; step <= 2; ++step) {
        for (const Eigen::Vector2i& way : {Eigen::Vector2i(step, 0), Eigen::Vector2i(-step, 0),
                                           Eigen::Vector2i(0, step), Eigen::Vector2i(0, -step)}) {
          if (!cells_.contains(cell + way)) support.emplace(cell + way, 0);
        }
      }
    }
    std::vector<std::pair<std::size_t, Eigen::Vector2i>> order;
    for (const auto& [cell, count] : support) {
      const std::size_t known = around(cell).size();
      const auto tried = tried_.find(cell);
      if (known >= 4 && (tried == tried_.end() || tried->second != known)) {
        order.emplace_back(known, cell);
      }
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    bool grown = false;
    for (const auto& [count, cell] : order) {
      const auto known = around(cell);
      tried_[cell] = known.size();
      const int corner = fitting(cell, known);
      if (corner < 0) continue;
      take(cell, corner);
      grown = true;
    }
    return grown;
  }

  bool inWholeSquare(const Eigen::Vector2i& cell) const {
    for (const int dx : {-1, 1}) {
      for (const int dy : {-1, 1}) {
        if (cells_.contains(cell + Eigen::Vector2i(dx, 0)) &&
            cells_.contains(cell + Eigen::Vector2i(0, dy)) &&
            cells_.contains(cell + Eigen::Vector2i(dx, dy))) {
          return true;
        }
      }
    }
    return false;
  }

  // How far a node is from where those around it predict it, in squares.
  double missOf(const Eigen::Vector2i& cell, int corner) const {
    const auto homography = fitHomography(around(cell));
    if (!homography) return 0.0;
    const Eigen::Vector2d place = cell.cast<double>();
    return (throughHomography(*homography, place) - cornerAt(corner).pixel).norm() /
           leastStretch(homographyJacobian(*homography, place));
  }

  // Takes out what the finished lattice around it contradicts, the worst first, for it spoils the
  // prediction of its neighbours; and what belongs to no whole square.
  void prune() {
    while (true) {
      auto worst = cells_.end();
      double most = snap_;
      for (auto it = cells_.begin(); it != cells_.end(); ++it) {
        const double miss = inWholeSquare(it->first) ? missOf(it->first, it->second) : 1e9;
        if (miss > most) {
          most = miss;
          worst = it;
        }
      }
      if (worst == cells_.end()) return;
      cells_.erase(worst);
    }
  }

  std::span<const XCorner> corners_;
  const CornerIndex& index_;
  double snap_;
  const std::vector<bool>* used_ = nullptr;
  Cells cells_;
  std::set<int> taken_;
  std::map<Eigen::Vector2i, std::size_t, RowByRow> tried_;  // with how many around, in vain
  int polarity_ = 0;
};

CornerLattice packed(const Cells& cells, int polarity) {
  Eigen::Vector2i least = cells.begin()->first;
  Eigen::Vector2i most = least;
  for (const auto& [cell, corner] : cells) {
    least = least.cwiseMin(cell);
    most = most.cwiseMax(cell);
  }
  CornerLattice lattice;
  lattice.size = most - least + Eigen::Vector2i::Ones();
  for (const auto& [cell, corner] : cells) lattice.nodes.push_back({cell - least, corner});
  const int at_origin = ((least.x() + least.y()) & 1) != 0 ? -polarity : polarity;
  lattice.origin_dark = at_origin < 0;
  return lattice;
}

}  // namespace

Result<void> CornerLatticeOptions::validate() const {
  if (snap > 0.0 && snap < 0.5 && min_nodes >= 4 && max_lattices >= 1 && max_lattices <= 100) {
    return {};
  }
  return Error{Error::Code::kInvalidInput, "An option of the lattice search is out of its range.",
               "Use a snap between 0 and 0.5 squares and at least 4 corners."};
}

std::vector<CornerLattice> growLattices(std::span<const XCorner> corners,
                                        const CornerLatticeOptions& options) {
  GYRE_CHECK(options.validate().ok());
  const CornerIndex index(corners);
  std::vector<bool> used(corners.size(), false);
  std::vector<CornerLattice> lattices;
  for (std::size_t seed = 0; seed < corners.size(); ++seed) {
    if (used[seed]) continue;
    Grower grower(corners, index, options.snap);
    const Cells cells = grower.grow(static_cast<int>(seed), used);
    if (static_cast<int>(cells.size()) < options.min_nodes) continue;
    for (const auto& [cell, corner] : cells) used[static_cast<std::size_t>(corner)] = true;
    lattices.push_back(packed(cells, grower.polarity()));
  }
  std::stable_sort(lattices.begin(), lattices.end(),
                   [](const auto& a, const auto& b) { return a.nodes.size() > b.nodes.size(); });
  if (lattices.size() > static_cast<std::size_t>(options.max_lattices)) {
    lattices.resize(static_cast<std::size_t>(options.max_lattices));
  }
  return lattices;
}

}  // namespace gyre
