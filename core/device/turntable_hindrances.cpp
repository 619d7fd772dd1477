// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/turntable_hindrances.h"

#include <cmath>

#include "core/base/formatted.h"
#include "core/device/protocols/grbl.h"

namespace gyre {
namespace {

std::string shortNumber(double value) { return formatted("%g", value); }

}  // namespace

double wholeStepsPerTurn(double steps_per_unit, double units_per_turn) {
  const double steps = steps_per_unit * units_per_turn;
  const double hidden = 0.0005 * units_per_turn;
  const double whole = std::round(steps);
  return std::abs(steps - whole) <= hidden && whole > 0.0 ? whole : steps;
}

std::vector<std::string> turntableHindrances(const std::map<int, double>& settings,
                                             const TurntableOptions& options) {
  std::vector<std::string> found;
  const int axis = static_cast<int>(grblAxisIndex(options.axis.front()));
  const auto setting = [&](int number, double otherwise) {
    const auto entry = settings.find(number);
    return entry == settings.end() ? otherwise : entry->second;
  };
  if (const double idle_ms = setting(1, 255.0); idle_ms != 255.0) {
    found.push_back("The motor is switched off " + shortNumber(idle_ms) +
                    " ms after each move ($1), and may slip: send $1=255 to keep it on.");
  }
  if (setting(20, 0.0) != 0.0) {
    found.emplace_back("Soft limits are on ($20): the table stops before a full turn: send $20=0.");
  }
  if (setting(21, 0.0) != 0.0) {
    found.emplace_back(
        "Hard limits are on ($21): noise on an unused switch input stops the table: send $21=0.");
  }
  if (setting(22, 0.0) != 0.0) {
    found.emplace_back("Homing is on ($22): the board is locked after each start: send $22=0.");
  }
  if (setting(32, 0.0) != 0.0) {
    found.emplace_back("Laser mode is on ($32): send $32=0 unless a laser is connected.");
  }
  const double steps = setting(100 + axis, 0.0) * options.units_per_turn;
  if (options.steps_per_turn == 0.0 && !options.turning_measured && steps > 0.0 &&
      wholeStepsPerTurn(steps / options.units_per_turn, options.units_per_turn) !=
          std::round(steps)) {
    found.push_back("One turn is " + shortNumber(steps) + " motor steps by $" +
                    std::to_string(100 + axis) +
                    ", not a whole number: measure the steps per turn.");
  }
  const double fastest_deg_per_s = setting(110 + axis, 0.0) / 60.0 * 360.0 / options.units_per_turn;
  if (fastest_deg_per_s > 0.0 && fastest_deg_per_s < options.speed_deg_per_s) {
    found.push_back("The table turns at most " + shortNumber(fastest_deg_per_s) + " deg/s ($" +
                    std::to_string(110 + axis) + ").");
  }
  return found;
}

}  // namespace gyre
