// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/corner_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gyre {
namespace {

constexpr double kCell_px = 32.0;

int cellOf(double coordinate) { return static_cast<int>(std::floor(coordinate / kCell_px)); }

}  // namespace

CornerIndex::CornerIndex(std::span<const XCorner> corners) {
  if (corners.empty()) return;
  Eigen::Vector2d most = corners[0].pixel;
  origin_ = most;
  for (const XCorner& corner : corners) {
    pixels_.push_back(corner.pixel);
    origin_ = origin_.cwiseMin(corner.pixel);
    most = most.cwiseMax(corner.pixel);
  }
  columns_ = cellOf(most.x() - origin_.x()) + 1;
  rows_ = cellOf(most.y() - origin_.y()) + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Eigen::Vector2d off = pixels_[i] - origin_;
    cells_[static_cast<std::size_t>(cellOf(off.y()) * columns_ + cellOf(off.x()))].push_back(
        static_cast<int>(i));
  }
}

// Calls visit(index) for all corners of the cells at this distance of a cell.
template <class Visit>
void CornerIndex::visitRing(int column, int row, int ring, Visit visit) const {
  for (int r = std::max(0, row - ring); r <= std::min(rows_ - 1, row + ring); ++r) {
    for (int c = std::max(0, column - ring); c <= std::min(columns_ - 1, column + ring); ++c) {
      if (std::max(std::abs(r - row), std::abs(c - column)) != ring) continue;
      for (const int i : cells_[static_cast<std::size_t>(r * columns_ + c)]) visit(i);
    }
  }
}

int CornerIndex::nearestWithin(const Eigen::Vector2d& pixel, double radius_px) const {
  int best = -1;
  if (!pixel.allFinite()) return best;
  double nearest = radius_px;
  const Eigen::Vector2d off = pixel - origin_;
  const Eigen::Vector2d size(columns_ * kCell_px, rows_ * kCell_px);
  if ((off.array() < -radius_px).any() || (off.array() > size.array() + radius_px).any()) {
    return best;
  }
  const int most_rings = static_cast<int>(std::ceil(radius_px / kCell_px));
  for (int ring = 0; ring <= most_rings; ++ring) {
    visitRing(cellOf(off.x()), cellOf(off.y()), ring, [&](int i) {
      const double distance = (pixels_[static_cast<std::size_t>(i)] - pixel).norm();
      if (distance > nearest || (distance == nearest && best >= 0)) return;
      nearest = distance;
      best = i;
    });
  }
  return best;
}

std::vector<int> CornerIndex::nearest(const Eigen::Vector2d& pixel, std::size_t count) const {
  std::vector<std::pair<double, int>> found;
  const Eigen::Vector2d off = pixel - origin_;
  const int column = std::clamp(cellOf(off.x()), 0, std::max(0, columns_ - 1));
  const int row = std::clamp(cellOf(off.y()), 0, std::max(0, rows_ - 1));
  // What lies beyond a ring is at least as far away as the ring is wide.
  for (int ring = 0; ring <= std::max(columns_, rows_); ++ring) {
    std::sort(found.begin(), found.end());
    if (found.size() >= count && found[count - 1].first <= (ring - 1) * kCell_px) break;
    visitRing(column, row, ring, [&](int i) {
      found.emplace_back((pixels_[static_cast<std::size_t>(i)] - pixel).norm(), i);
    });
  }
  std::sort(found.begin(), found.end());
  if (found.size() > count) found.resize(count);
  std::vector<int> indices;
  indices.reserve(found.size());
  for (const auto& [distance, i] : found) indices.push_back(i);
  return indices;
}

}  // namespace gyre
