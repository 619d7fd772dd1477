// The table's angles before and after the object's own features were asked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/recover/options.h"
#include "core/recover/turn_estimator.h"
#include "core/scan/turning.h"

namespace gyre {

// What the motor, or a ring of markers where it was seen, leaves open. [rad], one a view
struct AngleBeliefs {
  std::vector<double> expected_sigma_rad;
  std::vector<double> prior_sigma_rad;

  AngleKnowledge knowledge() const { return {expected_sigma_rad, prior_sigma_rad}; }
};

// The first view's angle is exact: it fixes the table frame.
AngleBeliefs beliefsBeforeSolving(std::span<const TurnedView> views, const RecoverOptions& options);

// The report with the angles that the features told. before: of a ring of markers, or, where there
// is none, the views alone, whose sentence is then written here.
TurningReport afterSolving(TurningReport before, const TurnEstimate& solved);

}  // namespace gyre
