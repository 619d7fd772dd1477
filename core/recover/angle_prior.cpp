// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/angle_prior.h"

#include "core/base/check.h"

namespace gyre {

Eigen::MatrixXd informationOf(const AnglePrior& prior) {
  const auto views = static_cast<Eigen::Index>(prior.sigma_rad.size());
  GYRE_CHECK(prior.turned_rad.empty() || prior.turned_rad.size() == prior.sigma_rad.size());
  Eigen::VectorXd own = Eigen::VectorXd::Zero(views);     // 1 / variance
  Eigen::VectorXd pulled = Eigen::VectorXd::Zero(views);  // D^-1 t
  double strength = 0.0;                                  // t' D^-1 t
  for (Eigen::Index view = 0; view < views; ++view) {
    const auto i = static_cast<std::size_t>(view);
    if (!(prior.sigma_rad[i] > 0.0)) continue;
    own[view] = 1.0 / (prior.sigma_rad[i] * prior.sigma_rad[i]);
    if (prior.turned_rad.empty()) continue;
    pulled[view] = own[view] * prior.turned_rad[i];
    strength += pulled[view] * prior.turned_rad[i];
  }
  Eigen::MatrixXd information = own.asDiagonal();
  const double variance = prior.scale_sigma * prior.scale_sigma;
  if (variance > 0.0 && strength > 0.0) {  // Sherman and Morrison
    information -= variance / (1.0 + variance * strength) * pulled * pulled.transpose();
  }
  return information;
}

}  // namespace gyre
