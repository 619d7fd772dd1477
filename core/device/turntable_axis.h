// What a board's settings mean for the one axis that turns the table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>

#include "core/base/result.h"
#include "core/device/options.h"

namespace gyre {

struct TurntableAxis {
  char letter = 'X';
  std::size_t index = 0;
  double steps_per_unit = 0.0;
  double steps_per_turn = 0.0;
  double feed_units_per_s = 0.0;
  double acceleration_units_per_s2 = 0.0;
};

// From the board's $ settings by number, as far as the options do not say otherwise. Fails when
// neither tells the motor steps of a unit.
Result<TurntableAxis> turntableAxis(const std::map<int, double>& settings,
                                    const TurntableOptions& options);

// The options of a table that was seen to turn by so much for each radian it was told, negative for
// clockwise: with these one radian told is one turned, and positive is counter-clockwise.
// turned_over_told: not 0.
TurntableOptions correctedOptions(TurntableOptions options, double turned_over_told);

}  // namespace gyre
