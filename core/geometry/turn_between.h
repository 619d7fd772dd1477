// The turn about the table's axis that best carries one set of points onto another.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

namespace gyre {

// By least squares over corresponding points; 0 when no turn is better than another, as for points
// on the axis. [rad], counter-clockwise. Where the table stood at angle 0 is a choice of the
// frame: results are compared after it. Any thread.
double turnBetween(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

}  // namespace gyre
