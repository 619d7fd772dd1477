// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/hand_turntable.h"

#include <cmath>

#include "core/base/units.h"

namespace gyre {
namespace {

constexpr double kUsualTicks = 360.0;

}  // namespace

HandTurntable::HandTurntable(const TurntableOptions& options, AskPerson ask)
    : ask_(std::move(ask)) {
  info_.firmware = "turned by hand";
  info_.device_id = "hand";
  info_.axis = options.axis;
  info_.direction = 1;
  info_.steps_per_turn =
      options.steps_per_turn > 0.0 ? std::round(options.steps_per_turn) : kUsualTicks;
  info_.units_per_turn = info_.steps_per_turn;
}

Result<std::unique_ptr<HandTurntable>> HandTurntable::open(const TurntableOptions& options,
                                                           AskPerson ask) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  if (!ask) {
    return Error{Error::Code::kInvalidInput, "Nobody is there who could turn the table by hand.",
                 "Use the command line in a terminal, or name a turntable with a motor."};
  }
  return std::unique_ptr<HandTurntable>(new HandTurntable(options, std::move(ask)));
}

std::int64_t HandTurntable::ticksFor(double angle_rad) const {
  return std::llround(angle_rad / kTurn_rad * info_.steps_per_turn);
}

double HandTurntable::angleRad() const {
  return static_cast<double>(steps()) / info_.steps_per_turn * kTurn_rad;
}

std::optional<double> HandTurntable::angleAt(const TablePlace& place) const {
  return static_cast<double>(place.motor_steps - origin_ticks_) / info_.steps_per_turn * kTurn_rad;
}

Result<void> HandTurntable::moveTo(double angle_rad, const Task& task) {
  stop_requested_ = false;
  if (!std::isfinite(angle_rad)) {
    return Error{Error::Code::kInvalidInput, "The angle to turn to is not a number.", ""};
  }
  if (task.stopRequested()) return cancelled();
  const std::int64_t target = origin_ticks_ + ticksFor(angle_rad);
  if (target == ticks_) return {};
  HandTurn turn;
  turn.ticks = target - ticks_;
  turn.tick_deg = 360.0 / info_.steps_per_turn;
  const double turns = static_cast<double>(target - origin_ticks_) / info_.steps_per_turn;
  turn.to_deg = (turns - std::floor(turns)) * 360.0;
  if (const Result<void> turned = ask_(turn, task); !turned) return turned;
  if (stop_requested_) return cancelled();
  ticks_ = target;
  return {};
}

Result<void> HandTurntable::setAngle(double angle_rad) {
  if (!std::isfinite(angle_rad)) {
    return Error{Error::Code::kInvalidInput, "The angle to set is not a number.", ""};
  }
  origin_ticks_ = ticks_ - ticksFor(angle_rad);
  return {};
}

// Marks are where they are: a person who turns the other way round has to be told, not corrected.
Result<void> HandTurntable::correct(double turned_over_told) {
  if (turned_over_told == 1.0) return {};
  return Error{Error::Code::kRejected,
               "The table was turned by another angle than was asked for, or the other way round.",
               "Count the marks of one turn, and turn counter-clockwise seen from above."};
}

}  // namespace gyre
