// What in a GRBL board's settings stands in the way of turning a table, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/device/options.h"

namespace gyre {

// Motor steps of one turn. Steps per unit are told with three decimals only: within what that
// hides, a whole number is meant (8.889 a degree are 3200 a turn, not 3200.04).
double wholeStepsPerTurn(double steps_per_unit, double units_per_turn);

// A sentence each, with its cure. Changes nothing; an empty list when all is well.
std::vector<std::string> turntableHindrances(const std::map<int, double>& settings,
                                             const TurntableOptions& options);

}  // namespace gyre
