// What a caliper on the printed rulers says of a target's true size.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/scan/target.h"

namespace gyre {

// How long the two printed rulers truly are, measured with a caliper.
struct RulerReading {
  double right_mm = 100.0;    // the ruler along the width of the page
  double down_mm = 100.0;     // the ruler along its height
  double nominal_mm = 100.0;  // what both are printed to be, > 0
};

// The target with every face stretched about its middle as the paper was. Targets without page axes
// are stretched evenly by the mean of both readings, about the origin.
//
// Where faces meet, their corners no longer coincide exactly when the two readings differ: each
// face is right in itself, which is what a solver with free faces needs. Fails when a reading is no
// length, or more than 10 % off the nominal one, which is a slip of the hand rather than a printer.
Result<Target> scaledByRulers(const Target& target, const RulerReading& reading);

}  // namespace gyre
