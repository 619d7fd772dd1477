// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocol_turntable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "core/base/units.h"
#include "core/device/protocols/grbl_driver.h"
#include "core/device/turntable_axis.h"

namespace gyre {
namespace {

constexpr int kTries = 3;
constexpr double kLongestApproach_deg = 45.0;  // as TurntableOptions allow

Error angleUnknown() {
  return {Error::Code::kAlarm, "The angle of the turntable is not known any more.",
          "Bring it to a known position and set the angle anew."};
}

}  // namespace

Result<std::unique_ptr<ProtocolTurntable>> ProtocolTurntable::open(
    std::unique_ptr<TableDriver> driver, const TurntableOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  const Interrupted interrupted = [&] { return task.stopRequested(); };
  const Result<void> known = driver->identify(options.greeting_s, interrupted);
  if (!known) return known.error();
  return adopt(std::move(driver), options, task);
}

Result<std::unique_ptr<ProtocolTurntable>> ProtocolTurntable::open(std::unique_ptr<BytePort> port,
                                                                   const TurntableOptions& options,
                                                                   const Task& task) {
  return open(std::make_unique<GrblDriver>(std::move(port)), options, task);
}

Result<std::unique_ptr<ProtocolTurntable>> ProtocolTurntable::adopt(
    std::unique_ptr<TableDriver> driver, const TurntableOptions& options, const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  std::unique_ptr<ProtocolTurntable> table(new ProtocolTurntable(std::move(driver), options));
  if (const Result<void> adopted = table->setUp(options); !adopted) return adopted.error();
  if (options.may_unlock) table->driver_->allowUnlock();
  const Result<std::int64_t> place = table->driver_->place([&] { return task.stopRequested(); });
  if (!place) return place.error();
  table->place_steps_ = table->origin_steps_ = *place;
  table->angle_known_ = true;
  return table;
}

Result<void> ProtocolTurntable::setUp(const TurntableOptions& options) {
  const Result<TableMotor> motor = driver_->setUp(options);
  if (!motor) return motor.error();
  motor_ = *motor;
  options_ = options;
  options_.units_per_turn = motor_.units_per_turn;
  info_.firmware = motor_.firmware;
  info_.device_id = options.device_id.empty() ? driver_->portName() : options.device_id;
  info_.axis = options.axis;
  info_.units_per_turn = motor_.units_per_turn;
  info_.direction = options.direction;
  info_.steps_per_turn = motor_.steps_per_turn;
  info_.hindrances = motor_.hindrances;
  return {};
}

// The board's own count does not change, but what it means.
Result<void> ProtocolTurntable::correct(double turned_over_told) {
  if (!std::isfinite(turned_over_told) || turned_over_told == 0.0) {
    return Error{Error::Code::kInvalidInput, "The table's ratio of turning is not a number.", ""};
  }
  const TurntableOptions corrected = correctedOptions(options_, turned_over_told);
  if (const Result<void> valid = corrected.validate(); !valid) return valid;
  if (const Result<void> adopted = setUp(corrected); !adopted) return adopted;
  origin_steps_ = place_steps_;
  return {};
}

double ProtocolTurntable::angleOf(std::int64_t place_steps) const {
  return options_.direction * static_cast<double>(place_steps - origin_steps_) /
         motor_.steps_per_turn * kTurn_rad;
}

std::optional<double> ProtocolTurntable::angleAt(const TablePlace& place) const {
  if (!angle_known_ || driver_->trouble() || place.count != count_) return std::nullopt;
  return angleOf(place.motor_steps);
}

std::int64_t ProtocolTurntable::steps() const {
  return options_.direction * (place_steps_ - origin_steps_);
}

std::int64_t ProtocolTurntable::stepsFor(double angle_rad) const {
  return options_.direction * std::llround(angle_rad / kTurn_rad * motor_.steps_per_turn);
}

// What every failure leaves behind: a table that stands, and an angle that is known or not.
Error ProtocolTurntable::fail(const Error& error) {
  if (error.code == Error::Code::kAlarm) angle_known_ = false;
  if (error.code == Error::Code::kGone) return error;
  const Result<std::optional<std::int64_t>> halted = driver_->halt();
  if (halted) {
    if (*halted) {
      place_steps_ = **halted;
    } else {
      angle_known_ = false;
    }
    return error;
  }
  angle_known_ = false;
  if (error.code == Error::Code::kCancelled || halted.error().code == Error::Code::kGone) {
    return halted.error();
  }
  return {error.code, error.what + " It may still be turning.", "Switch off its motor power."};
}

Result<void> ProtocolTurntable::moveTo(double angle_rad, const Task& task) {
  stop_requested_ = false;
  if (!std::isfinite(angle_rad)) {
    return Error{Error::Code::kInvalidInput, "The angle to turn to is not a number.", ""};
  }
  if (driver_->trouble()) angle_known_ = false;
  if (!angle_known_) return driver_->trouble().value_or(angleUnknown());
  const std::int64_t target = origin_steps_ + stepsFor(angle_rad);
  if (std::abs(static_cast<double>(target)) > motor_.farthest_steps) {
    return Error{Error::Code::kRejected,
                 "The table has turned so far that its firmware begins to lose precision.",
                 "Switch the board off and on, then connect again."};
  }
  const Interrupted interrupted = [&] { return stop_requested_ || task.stopRequested(); };
  if (interrupted()) return cancelled();
  for (int i = 0; i < kTries; ++i) {
    const Result<void> ready = driver_->makeReady(place_steps_, interrupted);
    if (!ready && ready.error().code == Error::Code::kNoPermission)
      return ready;  // nothing was begun
    if (!ready) return fail(ready.error());
    const Result<bool> arrived = attempt(target, interrupted);
    if (!arrived) return fail(arrived.error());
    if (*arrived) return {};
  }
  return fail({Error::Code::kRejected, "The table stops at another angle than it is sent to.",
               "Look for a program or a hand that moves it too, and for a bad cable."});
}

// False when the table strayed.
Result<bool> ProtocolTurntable::attempt(std::int64_t target, const Interrupted& interrupted) {
  const std::int64_t way = target - place_steps_;
  if (way == 0) return true;
  // A backward move goes past its target and returns.
  const bool backward = way * options_.direction < 0 && options_.approach_deg > 0.0;
  const std::array<std::int64_t, 2> places = {target - stepsFor(radFromDeg(options_.approach_deg)),
                                              target};
  const auto end = driver_->travel(std::span(places).subspan(backward ? 0 : 1), interrupted);
  if (!end) return end.error();
  place_steps_ = *end;
  return place_steps_ == target;
}

Result<void> ProtocolTurntable::setAngle(double angle_rad) {
  if (!std::isfinite(angle_rad)) {
    return Error{Error::Code::kInvalidInput, "The angle to set is not a number.", ""};
  }
  const Result<bool> trouble = driver_->forgiveTrouble();
  if (!trouble) return trouble.error();
  if (*trouble) angle_known_ = false;
  const Result<std::int64_t> place = driver_->place({});
  if (!place) return place.error();
  place_steps_ = *place;
  origin_steps_ = place_steps_ - stepsFor(angle_rad);
  if (!angle_known_) ++count_;
  angle_known_ = true;
  return {};
}

void ProtocolTurntable::setApproach(double approach_rad) {
  options_.approach_deg = std::clamp(degFromRad(approach_rad), 0.0, kLongestApproach_deg);
}

double ProtocolTurntable::approachRad() const { return radFromDeg(options_.approach_deg); }

TurntableInfo ProtocolTurntable::info() const {
  TurntableInfo info = info_;
  if (const std::optional<Error> lock = driver_->lock()) info.lock = lock->sentence();
  return info;
}

Result<void> ProtocolTurntable::release() {
  const Result<void> released = driver_->release();
  if (released) angle_known_ = false;
  return released;
}

}  // namespace gyre
