// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/turntable_axis.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/device/protocols/grbl.h"
#include "core/device/turntable_hindrances.h"

namespace gyre {

Result<TurntableAxis> turntableAxis(const std::map<int, double>& settings,
                                    const TurntableOptions& options) {
  TurntableAxis axis;
  axis.letter = options.axis.front();
  axis.index = grblAxisIndex(axis.letter);
  const auto setting = [&](int base, double otherwise) {
    const auto found = settings.find(base + static_cast<int>(axis.index));
    return found == settings.end() ? otherwise : found->second;
  };
  axis.steps_per_unit = setting(100, options.steps_per_turn / options.units_per_turn);
  if (!(axis.steps_per_unit > 0.0)) {
    return Error{Error::Code::kRejected,
                 "The board does not tell the steps of its axis " + options.axis + ".",
                 "Choose another axis, or give the steps per turn."};
  }
  axis.steps_per_turn = options.steps_per_turn > 0.0
                            ? options.steps_per_turn
                            : wholeStepsPerTurn(axis.steps_per_unit, options.units_per_turn);
  const double wished = options.speed_deg_per_s * options.units_per_turn / 360.0;
  const double most = setting(110, 0.0) / 60.0;
  axis.feed_units_per_s = most > 0.0 ? std::min(wished, most) : wished;
  const double acceleration = setting(120, 0.0);
  axis.acceleration_units_per_s2 = acceleration > 0.0 ? acceleration : wished;
  return axis;
}

TurntableOptions correctedOptions(TurntableOptions options, double turned_over_told) {
  GYRE_CHECK(std::isfinite(turned_over_told) && turned_over_told != 0.0);
  options.units_per_turn /= std::abs(turned_over_told);
  options.steps_per_turn /= std::abs(turned_over_told);
  options.turning_measured = true;
  if (turned_over_told < 0.0) options.direction = -options.direction;
  return options;
}

}  // namespace gyre
