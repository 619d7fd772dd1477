// What is known of the table's angles before the pictures are asked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <Eigen/Core>

namespace gyre {

struct AnglePrior {
  // How far each view may be off by itself; 0 holds the angle. [rad], one a view
  std::span<const double> sigma_rad = {};
  // How far the motor told it had turned since the first view; 0 where something surer told the
  // angle. [rad], one a view, or empty
  std::span<const double> turned_rad = {};
  // Steps are too long or too short, all alike, by a share with this standard deviation.
  double scale_sigma = 0.0;
  // Corrections to begin with. [rad], one a view, or empty for none
  std::span<const double> start_rad = {};
};

// The inverse of the corrections' covariance D + scale_sigma^2 t t', where D holds the views' own
// variances and t how far they turned; rows and columns of held views are 0. [1/rad^2]
Eigen::MatrixXd informationOf(const AnglePrior& prior);

}  // namespace gyre
