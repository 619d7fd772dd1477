// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/polygon_clip.h"

namespace gyre {

// Sutherland and Hodgman: walk round, keep what is inside, add where an edge crosses the line.
std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d>& polygon,
                                     const HalfPlane& half) {
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& here = polygon[i];
    const Eigen::Vector2d& next = polygon[(i + 1) % polygon.size()];
    const double here_off = half.normal.dot(here) - half.most;
    const double next_off = half.normal.dot(next) - half.most;
    if (here_off <= 0.0) kept.push_back(here);
    if ((here_off < 0.0 && next_off > 0.0) || (here_off > 0.0 && next_off < 0.0)) {
      kept.emplace_back(here + here_off / (here_off - next_off) * (next - here));
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace gyre
