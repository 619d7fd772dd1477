// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocol_turntable.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/turntable_hindrances.h"

namespace gyre {
namespace {

constexpr int kTries = 3;
constexpr double kReply_s = 1.5;  // an exchange that moves nothing
constexpr double kSlice_s = 0.02;
constexpr double kPoll_s = 0.2;        // GRBL asks for at most 5 a second
constexpr double kPollAtEnd_s = 0.03;  // once the barrier has been answered
constexpr double kSilence_s = 3.0;     // polled, and not a word
constexpr double kSpareTime_s = 5.0;   // beyond 1.5 times what the move should take
constexpr double kStandstill_s = 3.0;  // beyond the time to slow down
constexpr double kGreeting_s = 2.0;
// Beyond this the firmware's float32 positions are coarser than a quarter step.
constexpr double kMostUnitsTimesStepsPerUnit = 0.25 * (1 << 23);

Error angleUnknown() {
  return {Error::Code::kAlarm, "The angle of the turntable is not known any more.",
          "Bring it to a known position and set the angle anew."};
}

}  // namespace

Result<std::unique_ptr<ProtocolTurntable>> ProtocolTurntable::open(std::unique_ptr<BytePort> port,
                                                                   const TurntableOptions& options,
                                                                   const Task& task) {
  if (const Result<void> valid = options.validate(); !valid) return valid.error();
  std::unique_ptr<ProtocolTurntable> table(new ProtocolTurntable(std::move(port), options));
  const Interrupted interrupted = [&] { return task.stopRequested(); };
  const Result<GrblBoardInfo> board = identifyGrbl(table->link_, options.greeting_s, interrupted);
  if (!board) return board.error();
  if (const Result<void> adopted = table->adopt(*board, options); !adopted) return adopted.error();
  const Result<GrblStatus> status = table->link_.status(kReply_s, interrupted);
  if (!status) return status.error();
  const Result<std::int64_t> machine = table->machineStepsIn(*status);
  if (!machine) return machine.error();
  table->machine_steps_ = table->origin_steps_ = *machine;
  table->angle_known_ = true;
  return table;
}

Result<void> ProtocolTurntable::adopt(const GrblBoardInfo& board, const TurntableOptions& options) {
  const Result<TurntableAxis> axis = turntableAxis(board.settings, options);
  if (!axis) return axis.error();
  axis_ = *axis;
  board_ = board;
  options_ = options;
  if (const auto inches = board.settings.find(13);
      inches != board.settings.end() && inches->second != 0.0) {
    link_.setReportScale(25.4);
  }
  info_.firmware = board.firmware;
  info_.device_id = options.device_id.empty() ? link_.name() : options.device_id;
  info_.axis = options.axis;
  info_.units_per_turn = options.units_per_turn;
  info_.direction = options.direction;
  info_.steps_per_turn = axis_.steps_per_turn;
  info_.hindrances = turntableHindrances(board.settings, options);
  return {};
}

// The board's own count does not change, but what it means.
Result<void> ProtocolTurntable::correct(double turned_over_told) {
  if (!std::isfinite(turned_over_told) || turned_over_told == 0.0) {
    return Error{Error::Code::kInvalidInput, "The table's ratio of turning is not a number.", ""};
  }
  const TurntableOptions corrected = correctedOptions(options_, turned_over_told);
  if (const Result<void> valid = corrected.validate(); !valid) return valid;
  if (const Result<void> adopted = adopt(GrblBoardInfo(board_), corrected); !adopted)
    return adopted;
  origin_steps_ = machine_steps_;
  return {};
}

double ProtocolTurntable::angleOf(std::int64_t machine_steps) const {
  return options_.direction * static_cast<double>(machine_steps - origin_steps_) /
         info_.steps_per_turn * kTurn_rad;
}

std::optional<double> ProtocolTurntable::angleAt(const TablePlace& place) const {
  if (!angle_known_ || link_.trouble() || place.count != count_) return std::nullopt;
  return angleOf(place.motor_steps);
}

std::int64_t ProtocolTurntable::steps() const {
  return options_.direction * (machine_steps_ - origin_steps_);
}

std::int64_t ProtocolTurntable::stepsFor(double angle_rad) const {
  return options_.direction * std::llround(angle_rad / kTurn_rad * info_.steps_per_turn);
}

// Time of a trapezoid over the way, with what the settings say.
double ProtocolTurntable::secondsFor(std::int64_t way_steps) const {
  const double way = static_cast<double>(std::abs(way_steps)) / axis_.steps_per_unit;
  return way / axis_.feed_units_per_s +
         2.0 * axis_.feed_units_per_s / axis_.acceleration_units_per_s2;
}

bool ProtocolTurntable::standsAt(const GrblStatus& status, std::int64_t machine_steps) const {
  if (axis_.index >= status.machine.size()) return false;
  // Half a step, and the last digit of the report.
  const double target = static_cast<double>(machine_steps) / axis_.steps_per_unit;
  return std::abs(status.machine[axis_.index] - target) <= 0.5 / axis_.steps_per_unit + 0.001;
}

Result<std::int64_t> ProtocolTurntable::machineStepsIn(const GrblStatus& status) const {
  if (axis_.index >= status.machine.size()) {
    return Error{Error::Code::kRejected, "The board has no axis " + options_.axis + ".",
                 "Choose another axis."};
  }
  return std::llround(status.machine[axis_.index] * axis_.steps_per_unit);
}

// What every failure leaves behind: a table that stands, and an angle that is known or not.
Error ProtocolTurntable::fail(const Error& error) {
  if (error.code == Error::Code::kAlarm) angle_known_ = false;
  if (error.code == Error::Code::kGone) return error;
  const Result<void> halted = halt();
  if (halted) return error;
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
  if (link_.trouble()) angle_known_ = false;
  if (!angle_known_) return link_.trouble().value_or(angleUnknown());
  const std::int64_t target = origin_steps_ + stepsFor(angle_rad);
  if (std::abs(static_cast<double>(target)) > kMostUnitsTimesStepsPerUnit) {
    return Error{Error::Code::kRejected,
                 "The table has turned so far that its firmware begins to lose precision.",
                 "Switch the board off and on, then connect again."};
  }
  const Interrupted interrupted = [&] { return stop_requested_ || task.stopRequested(); };
  if (interrupted()) return cancelled();
  for (int i = 0; i < kTries; ++i) {
    const Result<void> ready = makeReady(interrupted);
    if (!ready) return fail(ready.error());
    const Result<Outcome> outcome = attempt(target, interrupted);
    if (!outcome) return fail(outcome.error());
    if (*outcome == Outcome::kArrived) {
      machine_steps_ = target;
      return {};
    }
  }
  return fail({Error::Code::kRejected, "The table stops at another angle than it is sent to.",
               "Look for a program or a hand that moves it too, and for a bad cable."});
}

// Idle, unlocked, and where it was left.
Result<void> ProtocolTurntable::makeReady(const Interrupted& interrupted) {
  bool moved = false;
  for (int i = 0; i < 2 * kTries; ++i) {
    const Result<GrblStatus> status = link_.status(kReply_s, interrupted);
    if (!status) return status.error();
    if (status->state == GrblState::kIdle) {
      const Result<std::int64_t> machine = machineStepsIn(*status);
      if (!machine) return machine.error();
      if (standsAt(*status, machine_steps_)) return {};
      moved = true;  // or the report is spoilt: ask again
      continue;
    }
    if (const Result<void> woken = wake(*status, interrupted); !woken) return woken;
  }
  if (moved) {
    return Error{Error::Code::kAlarm, "The table is not where it was left, by its board's count.",
                 "Bring it to a known position and set the angle anew."};
  }
  return Error{Error::Code::kRejected, "The board does not become ready to move.",
               "Reset it, then connect again."};
}

// Leads from the state to Idle, where that moves nothing.
Result<void> ProtocolTurntable::wake(const GrblStatus& status, const Interrupted& interrupted) {
  switch (status.state) {
    case GrblState::kAlarm: {
      // The caller has just set the angle, or connected: nothing is lost by unlocking.
      const Result<void> unlocked = link_.command("$X", kReply_s, interrupted);
      if (!unlocked && unlocked.error().code != Error::Code::kTimeout) return unlocked;
      return {};
    }
    case GrblState::kSleep:
    case GrblState::kHold:
      return softReset();
    case GrblState::kDoor:
      return Error{Error::Code::kRejected, "The board says that its safety door is open.",
                   "Close it, or disable the door input of the firmware."};
    case GrblState::kCheck:
      return Error{Error::Code::kRejected, "The board is in check mode and turns nothing.",
                   "Reset it, then connect again."};
    default:
      return Error{Error::Code::kBusy, "The table is moving already.",
                   "Stop what drives it, then try again."};
  }
}

// Goes to the target, always arriving in the same direction, so that play in the gears is on the
// same side for every view.
Result<ProtocolTurntable::Outcome> ProtocolTurntable::attempt(std::int64_t target,
                                                              const Interrupted& interrupted) {
  const std::int64_t from = machine_steps_;
  const std::int64_t way = target - from;
  if (way == 0) return Outcome::kArrived;
  double seconds = secondsFor(way);
  if (way * options_.direction < 0 && options_.approach_deg > 0.0) {
    const std::int64_t past = stepsFor(radFromDeg(options_.approach_deg));
    seconds += 2.0 * secondsFor(past);
    const Result<void> sent = sendMove(target - past, interrupted);
    if (!sent) return sent.error();
  }
  const Result<void> sent = sendMove(target, interrupted);
  if (!sent) return sent.error();
  const Result<void> barrier = link_.send(std::string(kGrblBarrier) + "\n");
  if (!barrier) return barrier.error();
  return awaitArrival(target, 1.5 * seconds + kSpareTime_s, interrupted);
}

// A move whose answer is lost is sent again: being absolute, it does no harm twice.
Result<void> ProtocolTurntable::sendMove(std::int64_t target, const Interrupted& interrupted) {
  const std::string line =
      grblMove(axis_.letter, static_cast<double>(target) / axis_.steps_per_unit,
               axis_.feed_units_per_s * 60.0);
  Result<void> sent;
  for (int i = 0; i < kTries; ++i) {
    sent = link_.command(line, kReply_s, interrupted);
    if (sent) return sent;
    const Error::Code code = sent.error().code;
    if (code != Error::Code::kTimeout && code != Error::Code::kRejected) return sent;
    // What is left of a spoilt line would spoil the next one.
    if (const Result<void> ended = link_.send("\n"); !ended) return ended;
    if (const Result<void> quiet = link_.drain(); !quiet) return quiet;
  }
  return sent;
}

Result<ProtocolTurntable::Outcome> ProtocolTurntable::awaitArrival(std::int64_t target,
                                                                   double timeout_s,
                                                                   const Interrupted& interrupted) {
  const double begin_s = steadySeconds();
  double heard_s = begin_s;
  double poll_s = begin_s + kPoll_s;
  double interval_s = kPoll_s;
  int strayed = 0;
  while (steadySeconds() < begin_s + timeout_s && steadySeconds() < heard_s + kSilence_s) {
    if (interrupted()) return cancelled();
    if (steadySeconds() >= poll_s) {
      poll_s = steadySeconds() + interval_s;
      const Result<void> sent = link_.send(std::string_view(&kGrblStatusRequest, 1));
      if (!sent) return sent.error();
    }
    const Result<std::optional<GrblMessage>> message = link_.receive(kSlice_s);
    if (!message) return message.error();
    if (link_.trouble()) return *link_.trouble();
    if (!*message) continue;
    heard_s = steadySeconds();
    if ((*message)->kind == GrblMessage::Kind::kOk) {
      poll_s = heard_s;  // the motion has ended, if this was the barrier's ok: look at once
      interval_s = kPollAtEnd_s;
    }
    if ((*message)->kind != GrblMessage::Kind::kStatus) continue;
    const GrblStatus& status = (*message)->status;
    if (status.state == GrblState::kIdle) {
      if (standsAt(status, target)) return Outcome::kArrived;
      // One report may be spoilt, or older than the start of the motion.
      if (++strayed < kTries) continue;
      const Result<std::int64_t> machine = machineStepsIn(status);
      if (!machine) return machine.error();
      machine_steps_ = *machine;
      return Outcome::kStrayed;
    } else if (status.state == GrblState::kRun) {
      strayed = 0;
      interval_s = kPoll_s;  // that ok was another's
    } else if (status.state == GrblState::kAlarm) {
      return Error{Error::Code::kAlarm, "The turntable has stopped by itself.",
                   "Remove the cause, then set the angle anew."};
    } else {
      return Error{Error::Code::kRejected, "The turntable was put on hold at its board.",
                   "Release the hold or close the door, then go on."};
    }
  }
  return Error{Error::Code::kTimeout, "The turntable has not reached its angle in time.",
               "Check its motor power and its cable."};
}

// Slows down, waits for standstill, and only then clears the queue: the position is kept.
Result<void> ProtocolTurntable::halt() {
  link_.forgiveTrouble();
  if (const Result<void> stands = awaitStandstill(); !stands) {
    angle_known_ = false;
    return stands;
  }
  return softReset();
}

Result<void> ProtocolTurntable::awaitStandstill() {
  const double slow_s = axis_.feed_units_per_s / axis_.acceleration_units_per_s2;
  const double deadline_s = steadySeconds() + slow_s + kStandstill_s;
  double ask_s = 0.0;
  std::vector<double> before;
  while (steadySeconds() < deadline_s) {
    if (steadySeconds() >= ask_s) {
      ask_s = steadySeconds() + kPoll_s / 2.0;
      const Result<void> sent = link_.send(std::string{kGrblHold, kGrblStatusRequest});
      if (!sent) return sent.error();
    }
    const Result<std::optional<GrblMessage>> message = link_.receive(kSlice_s);
    if (!message) return message.error();
    if (link_.trouble()) return {};  // an alarm or a restart: it stands, somewhere
    if (!*message || (*message)->kind != GrblMessage::Kind::kStatus) continue;
    const GrblStatus& status = (*message)->status;
    const bool still = status.machine == std::exchange(before, status.machine);
    if (status.state == GrblState::kHold
            ? status.substate.value_or(still ? 0 : 1) == 0
            : status.state != GrblState::kRun && status.state != GrblState::kJog) {
      return {};
    }
  }
  return Error{Error::Code::kTimeout, "The turntable does not confirm that it stands.",
               "Switch off its motor power."};
}

// Empties the board's queue. Only at rest: a reset in motion loses the position.
Result<void> ProtocolTurntable::softReset() {
  angle_known_ = angle_known_ && !link_.trouble();
  link_.forgiveTrouble();
  bool alarm = false;
  bool greeted = false;
  for (int i = 0; i < kTries && !greeted; ++i) {
    if (const Result<void> sent = link_.send(std::string_view(&kGrblSoftReset, 1)); !sent) {
      angle_known_ = false;
      return sent;
    }
    const double deadline_s = steadySeconds() + kGreeting_s / kTries;
    while (!greeted && steadySeconds() < deadline_s) {
      const Result<std::optional<GrblMessage>> message = link_.receive(kSlice_s);
      if (!message) return message.error();
      if (!*message) continue;
      alarm |= (*message)->kind == GrblMessage::Kind::kAlarm;
      greeted = (*message)->kind == GrblMessage::Kind::kBanner;
    }
  }
  if (const Result<void> quiet = link_.drain(); !quiet) return quiet;
  link_.forgiveTrouble();
  const Result<GrblStatus> status = link_.status(kReply_s, {});
  if (!status || !greeted || alarm) angle_known_ = false;
  if (!status) return status.error();
  const Result<std::int64_t> machine = machineStepsIn(*status);
  if (!machine) return machine.error();
  machine_steps_ = *machine;
  return {};
}

Result<void> ProtocolTurntable::setAngle(double angle_rad) {
  if (!std::isfinite(angle_rad)) {
    return Error{Error::Code::kInvalidInput, "The angle to set is not a number.", ""};
  }
  if (const Result<void> quiet = link_.drain(); !quiet) return quiet;
  angle_known_ = angle_known_ && !link_.trouble();
  link_.forgiveTrouble();
  const Result<GrblStatus> status = link_.status(kReply_s, {});
  if (!status) return status.error();
  if (status->state == GrblState::kRun || status->state == GrblState::kJog) {
    return Error{Error::Code::kBusy, "The table is moving.", "Wait until it stands."};
  }
  const Result<std::int64_t> machine = machineStepsIn(*status);
  if (!machine) return machine.error();
  machine_steps_ = *machine;
  origin_steps_ = machine_steps_ - stepsFor(angle_rad);
  if (!angle_known_) ++count_;
  angle_known_ = true;
  return {};
}

// $SLP switches the motor off until the next reset, and writes no setting.
Result<void> ProtocolTurntable::release() {
  const Result<void> asleep = link_.command("$SLP", kReply_s, {});
  if (asleep) angle_known_ = false;
  return asleep;
}

}  // namespace gyre
