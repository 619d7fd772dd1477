// The table's axis and angles from poses of a turning target: the linear beginning of the bundle.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace gyre {

// One rigid piece, as the pictures showed it: a pose a picture, none where it was not seen.
using PoseSeries = std::vector<std::optional<Rigid3>>;  // cam_from_piece

struct AxisInCam {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit length; sign as it came
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       // the axis's nearest to the camera, mm
};

// The line about which all pieces turn. With R = R_j R_i^T and t = t_j - R t_i between two
// pictures, its direction is the smallest eigenvector of sum (R - I)^T (R - I) and its point solves
// (I - R) p = t with direction . p = 0. Pairs that turn by less than min_turn_rad are left out, and
// those that disagree lose their weight. Nothing when no pair turned enough.
std::optional<AxisInCam> axisFromPoses(const std::vector<PoseSeries>& pieces, double min_turn_rad);

// How far the table stood turned in each picture, counter-clockwise about the direction, in
// (-pi, pi]; 0 in the first picture that shows anything. Pieces that share pictures are chained;
// none where no piece of the chain was seen.
std::vector<std::optional<double>> anglesFromPoses(const std::vector<PoseSeries>& pieces,
                                                   const Eigen::Vector3d& axis_in_cam);

// The angle in (-pi, pi].
double wrapped(double angle_rad);

}  // namespace gyre
