// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/turn_between.h"

#include <cmath>

#include "core/base/check.h"

namespace gyre {

double turnBetween(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to) {
  GYRE_CHECK(from.size() == to.size());
  double cross = 0.0;
  double dot = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    cross += from[i].x() * to[i].y() - from[i].y() * to[i].x();
    dot += from[i].x() * to[i].x() + from[i].y() * to[i].y();
  }
  return std::atan2(cross, dot);
}

}  // namespace gyre
