// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/watched_turntable.h"

#include <cmath>

#include "core/base/check.h"
#include "core/base/units.h"

namespace gyre {
namespace {

constexpr double kStepsPerTurn = 36000.0;
constexpr double kBetweenLooks_s = 0.05;
// The person is told anew when what is left has changed by so much.
constexpr double kWorthTelling_deg = 1.0;

std::int64_t stepsOf(double angle_rad) {
  return std::llround(angle_rad / kTurn_rad * kStepsPerTurn);
}

Error notSeen() {
  return {Error::Code::kNotFound, "The camera does not see where the table stands.",
          "Keep the platter's markers in the picture, in focus and lit."};
}

Error noNumber() {
  return {Error::Code::kInvalidInput, "The angle of the table is not a number.", ""};
}

}  // namespace

Result<std::unique_ptr<WatchedTurntable>> WatchedTurntable::open(SeeTable see, TellPerson tell,
                                                                 double near_enough_rad,
                                                                 const Task& task) {
  GYRE_CHECK(see && tell && near_enough_rad > 0.0);
  std::unique_ptr<WatchedTurntable> table(
      new WatchedTurntable(std::move(see), std::move(tell), near_enough_rad));
  const Result<bool> seen = table->look(task);
  if (!seen) return seen.error();
  if (!*seen) return notSeen();
  table->zero_rad_ = table->stands_rad_;
  return table;
}

// False when it cannot be seen. Of the turns that look alike the nearest is taken.
Result<bool> WatchedTurntable::look(const Task& task) {
  const Result<std::optional<double>> seen = see_(task);
  if (!seen) return seen.error();
  if (!*seen) return false;
  stands_rad_ += std::remainder(**seen - stands_rad_, kTurn_rad);
  return true;
}

Result<void> WatchedTurntable::moveTo(double angle_rad, const Task& task) {
  stop_requested_ = false;
  if (!std::isfinite(angle_rad)) return noNumber();
  std::optional<FreeTurn> told;
  for (;;) {
    if (stop_requested_ || task.stopRequested()) return cancelled();
    const Result<bool> seen = look(task);
    if (!seen) return seen.error();
    const double left_rad = angle_rad - angleRad();
    if (*seen && std::abs(left_rad) <= near_enough_rad_) return {};
    const double turns = angle_rad / kTurn_rad;
    const FreeTurn turn{*seen, degFromRad(left_rad), (turns - std::floor(turns)) * 360.0};
    if (!told || told->seen != turn.seen ||
        (turn.seen && std::abs(told->by_deg - turn.by_deg) > kWorthTelling_deg)) {
      told = turn;
      tell_(turn);
    }
    if (!task.sleepFor(kBetweenLooks_s)) return cancelled();
  }
}

std::int64_t WatchedTurntable::steps() const { return stepsOf(angleRad()); }

TablePlace WatchedTurntable::place() const { return {0, stepsOf(stands_rad_)}; }

std::optional<double> WatchedTurntable::angleAt(const TablePlace& place) const {
  return static_cast<double>(place.motor_steps) / kStepsPerTurn * kTurn_rad - zero_rad_;
}

Result<void> WatchedTurntable::setAngle(double angle_rad) {
  if (!std::isfinite(angle_rad)) return noNumber();
  zero_rad_ = stands_rad_ - angle_rad;
  return {};
}

Result<void> WatchedTurntable::correct(double turned_over_told) {
  return std::isfinite(turned_over_told) ? Result<void>() : noNumber();
}

TurntableInfo WatchedTurntable::info() const {
  TurntableInfo info;
  info.firmware = "turned by hand, watched by the camera";
  info.device_id = "hand";
  info.axis = "X";
  info.units_per_turn = 360.0;
  info.steps_per_turn = kStepsPerTurn;
  return info;
}

}  // namespace gyre
