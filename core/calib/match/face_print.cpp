// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/face_print.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr int kCircleCorners = 24;

// The squares of a face: the one at (column, row) lies between the corners (column, row) and
// (column + 1, row + 1); there is one more beyond each outer corner.
class Squares {
 public:
  Squares(const Target& target, const TargetFace& face) : face_(face) {
    for (const TargetFace::Corner& corner : face.corners) {
      first_mm_ = first_mm_.cwiseMin(corner.place_mm);
    }
    // The square at the first corner of the list that lies towards the last one is dark.
    const auto& ids = target.faces[static_cast<std::size_t>(face.index)];
    const Eigen::Array2i from = cellOf(target, ids.front());
    const Eigen::Array2i to = cellOf(target, ids.back());
    dark_parity_ =
        (from.x() + (to.x() > from.x() ? 0 : -1)) + (from.y() + (to.y() > from.y() ? 0 : -1));
  }

  bool isDark(int column, int row) const { return ((column + row - dark_parity_) & 1) == 0; }

  bool isDarkAt(const Eigen::Vector2d& place_mm) const {
    const Eigen::Array2d at = (place_mm - first_mm_).array() / face_.grid->pitch_mm.array();
    return isDark(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
  }

  PrintedArea square(int column, int row) const {
    PrintedArea area;
    for (const auto& [right, down] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      const Eigen::Vector2d cell(column + right, row + down);
      area.outline_in_target.push_back(
          face_.pointAt(first_mm_ + cell.cwiseProduct(face_.grid->pitch_mm)));
    }
    return area;
  }

 private:
  Eigen::Array2i cellOf(const Target& target, int corner_id) const {
    const auto corner =
        std::find_if(target.corners.begin(), target.corners.end(),
                     [&](const TargetCorner& each) { return each.id == corner_id; });
    const Eigen::Vector2d place_mm = face_.placeOf(corner->position_in_target);
    return ((place_mm - first_mm_).array() / face_.grid->pitch_mm.array()).round().cast<int>();
  }

  const TargetFace& face_;
  Eigen::Vector2d first_mm_ = Eigen::Vector2d::Constant(1e18);
  int dark_parity_ = 0;
};

PrintedArea roundMark(const TargetFace& face, const TargetDot& dot) {
  PrintedArea area;
  for (int k = 0; k < kCircleCorners; ++k) {
    const double angle_rad = kTurn_rad * k / kCircleCorners;
    const Eigen::Vector2d way(std::cos(angle_rad), std::sin(angle_rad));
    area.outline_in_target.push_back(
        dot.centre_in_target +
        0.5 * dot.diameter_mm * (way.x() * face.right_in_target + way.y() * face.down_in_target));
  }
  return area;
}

}  // namespace

std::vector<PrintedArea> printOf(const Target& target, const TargetFace& face) {
  std::vector<PrintedArea> areas;
  if (!face.grid || !face.markers.empty()) return areas;
  const Squares squares(target, face);
  for (int row = -1; row < face.grid->rows; ++row) {
    for (int column = -1; column < face.grid->columns; ++column) {
      if (squares.isDark(column, row)) areas.push_back(squares.square(column, row));
    }
  }
  for (const TargetDot& dot : target.dots) {
    if (!face.holds(dot.centre_in_target)) continue;
    areas.push_back(roundMark(face, dot));
    areas.back().dark = !squares.isDarkAt(face.placeOf(dot.centre_in_target));
  }
  return areas;
}

}  // namespace gyre
