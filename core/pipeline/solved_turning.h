// The table's angles before and after the object's own features were asked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/recover/options.h"
#include "core/recover/turn_estimator.h"
#include "core/scan/turning.h"

namespace gyre {

// What the motor, or a ring of markers where it was seen, leaves open; see AngleKnowledge.
struct AngleBeliefs {
  std::vector<double> expected_sigma_rad;
  std::vector<double> prior_sigma_rad;
  std::vector<double> turned_rad;
  std::vector<double> start_rad;
  double scale_sigma = 0.0;

  AngleKnowledge knowledge() const {
    return {expected_sigma_rad, {prior_sigma_rad, turned_rad, scale_sigma, start_rad}};
  }
};

// The first view's angle is exact: it fixes the table frame.
AngleBeliefs beliefsBeforeSolving(std::span<const TurnedView> views, const RecoverOptions& options);

// The report with the angles that the features told. before: of a ring of markers, or, where there
// is none, the views alone, whose sentence is then written here.
TurningReport afterSolving(TurningReport before, const TurnEstimate& solved);

}  // namespace gyre
