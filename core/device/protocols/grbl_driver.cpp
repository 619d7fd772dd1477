// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/grbl_driver.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

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
constexpr double kFarthest_steps = 0.25 * (1 << 23);

Error notWhereLeft() {
  return {Error::Code::kAlarm, "The table is not where it was left, by its board's count.",
          "Bring it to a known position and set the angle anew."};
}

}  // namespace

Result<void> GrblDriver::identify(double greeting_s, const Interrupted& interrupted) {
  Result<GrblBoardInfo> board = identifyGrbl(link_, greeting_s, interrupted);
  if (!board) return board.error();
  board_ = *std::move(board);
  if (const auto inches = board_.settings.find(13);
      inches != board_.settings.end() && inches->second != 0.0) {
    link_.setReportScale(25.4);
  }
  return {};
}

Result<TableMotor> GrblDriver::setUp(const TurntableOptions& options) {
  const Result<TurntableAxis> axis = turntableAxis(board_.settings, options);
  if (!axis) return axis.error();
  axis_ = *axis;
  TableMotor motor;
  motor.firmware = board_.firmware;
  motor.units_per_turn = options.units_per_turn;
  motor.steps_per_turn = axis_.steps_per_turn;
  motor.farthest_steps = kFarthest_steps;
  motor.hindrances = turntableHindrances(board_.settings, options);
  return motor;
}

// The board's state, and by it whether it is locked.
Result<GrblStatus> GrblDriver::status(const Interrupted& interrupted) {
  Result<GrblStatus> status = link_.status(kReply_s, interrupted);
  if (status) locked_ = status->state == GrblState::kAlarm || status->state == GrblState::kSleep;
  return status;
}

std::optional<Error> GrblDriver::lock() const {
  if (!locked_ || mayUnlock()) return std::nullopt;
  const auto homing = board_.settings.find(22);
  const bool homes = homing != board_.settings.end() && homing->second != 0.0;
  std::string why = "it stopped by itself, or its motors were asleep";
  if (link_.alarms() > 0) {
    why = "it has stopped by itself";
  } else if (slept_) {
    why = "its motor was let go of";
  } else if (homes) {
    why = "it starts so because homing is on ($22)";
  }
  return Error{Error::Code::kNoPermission,
               "The turntable's board is locked and moves nothing: " + why + ".",
               "When this is your turntable and nothing is in its way, allow that it is unlocked: "
               "with --unlock, or in the window's step 1."};
}

Result<std::int64_t> GrblDriver::place(const Interrupted& interrupted) {
  const Result<GrblStatus> status = this->status(interrupted);
  if (!status) return status.error();
  if (status->state == GrblState::kRun || status->state == GrblState::kJog) {
    return Error{Error::Code::kBusy, "The table is moving.", "Wait until it stands."};
  }
  const Result<std::int64_t> steps = stepsIn(*status);
  if (steps) stands_at_ = *steps;
  return steps;
}

// Time of a trapezoid over the way, with what the settings say.
double GrblDriver::secondsFor(std::int64_t way_steps) const {
  const double way = static_cast<double>(std::abs(way_steps)) / axis_.steps_per_unit;
  return way / axis_.feed_units_per_s +
         2.0 * axis_.feed_units_per_s / axis_.acceleration_units_per_s2;
}

bool GrblDriver::standsAt(const GrblStatus& status, std::int64_t steps) const {
  if (axis_.index >= status.machine.size()) return false;
  // Half a step, and the last digit of the report.
  const double target = static_cast<double>(steps) / axis_.steps_per_unit;
  return std::abs(status.machine[axis_.index] - target) <= 0.5 / axis_.steps_per_unit + 0.001;
}

Result<std::int64_t> GrblDriver::stepsIn(const GrblStatus& status) const {
  if (axis_.index >= status.machine.size()) {
    return Error{Error::Code::kRejected,
                 "The board has no axis " + std::string(1, axis_.letter) + ".",
                 "Choose another axis."};
  }
  return std::llround(status.machine[axis_.index] * axis_.steps_per_unit);
}

// Idle, unlocked, and where it was left.
Result<void> GrblDriver::makeReady(std::int64_t expected, const Interrupted& interrupted) {
  bool moved = false;
  for (int i = 0; i < 2 * kTries; ++i) {
    const Result<GrblStatus> status = this->status(interrupted);
    if (!status) return status.error();
    if (const std::optional<Error> locked = lock()) return *locked;
    if (status->state == GrblState::kIdle) {
      if (const Result<std::int64_t> steps = stepsIn(*status); !steps) return steps.error();
      if (standsAt(*status, expected)) {
        stands_at_ = expected;
        return {};
      }
      moved = true;  // or the report is spoilt: ask again
      continue;
    }
    if (const Result<void> woken = wake(*status, interrupted); !woken) return woken;
  }
  if (moved) return notWhereLeft();
  return Error{Error::Code::kRejected, "The board does not become ready to move.",
               "Reset it, then connect again."};
}

// Leads from the state to Idle, where that moves nothing.
Result<void> GrblDriver::wake(const GrblStatus& status, const Interrupted& interrupted) {
  switch (status.state) {
    case GrblState::kAlarm: {
      // A person has allowed it, and the caller has just set the angle, or connected.
      const Result<void> unlocked = link_.command("$X", kReply_s, interrupted);
      if (!unlocked && unlocked.error().code != Error::Code::kTimeout) return unlocked;
      return {};
    }
    case GrblState::kSleep:
    case GrblState::kHold: {
      const Result<std::optional<std::int64_t>> place = softReset();
      if (!place) return place.error();
      if (!*place) return notWhereLeft();
      return {};
    }
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

Result<std::int64_t> GrblDriver::travel(std::span<const std::int64_t> places,
                                        const Interrupted& interrupted) {
  double seconds = 0.0;
  std::int64_t from = stands_at_;
  for (const std::int64_t to : places) {
    seconds += secondsFor(to - from);
    if (const Result<void> sent = sendMove(to, interrupted); !sent) return sent.error();
    from = to;
  }
  const Result<void> barrier = link_.send(std::string(kGrblBarrier) + "\n");
  if (!barrier) return barrier.error();
  const Result<std::int64_t> end =
      awaitArrival(places.back(), 1.5 * seconds + kSpareTime_s, interrupted);
  if (end) stands_at_ = *end;
  return end;
}

// A move whose answer is lost is sent again: being absolute, it does no harm twice.
Result<void> GrblDriver::sendMove(std::int64_t target, const Interrupted& interrupted) {
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

// Where the table stands once the board is Idle.
Result<std::int64_t> GrblDriver::awaitArrival(std::int64_t target, double timeout_s,
                                              const Interrupted& interrupted) {
  const double begin_s = link_.now();
  double heard_s = begin_s;
  double poll_s = begin_s + kPoll_s;
  double interval_s = kPoll_s;
  int strayed = 0;
  while (link_.now() < begin_s + timeout_s && link_.now() < heard_s + kSilence_s) {
    if (interrupted()) return cancelled();
    if (link_.now() >= poll_s) {
      poll_s = link_.now() + interval_s;
      const Result<void> sent = link_.send(std::string_view(&kGrblStatusRequest, 1));
      if (!sent) return sent.error();
    }
    const Result<std::optional<GrblMessage>> message = link_.receive(kSlice_s);
    if (!message) return message.error();
    if (link_.trouble()) return *link_.trouble();
    if (!*message) continue;
    heard_s = link_.now();
    if ((*message)->kind == GrblMessage::Kind::kOk) {
      poll_s = heard_s;  // the motion has ended, if this was the barrier's ok: look at once
      interval_s = kPollAtEnd_s;
    }
    if ((*message)->kind != GrblMessage::Kind::kStatus) continue;
    const GrblStatus& status = (*message)->status;
    if (status.state == GrblState::kIdle) {
      if (standsAt(status, target)) return target;
      // One report may be spoilt, or older than the start of the motion.
      if (++strayed < kTries) continue;
      return stepsIn(status);
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
Result<std::optional<std::int64_t>> GrblDriver::halt() {
  link_.forgiveTrouble();
  if (!link_.needsReset()) {
    if (const Result<void> stands = awaitStandstill(); !stands) return stands.error();
  }
  return softReset();
}

Result<void> GrblDriver::awaitStandstill() {
  const double slow_s = axis_.feed_units_per_s / axis_.acceleration_units_per_s2;
  const double deadline_s = link_.now() + slow_s + kStandstill_s;
  double ask_s = 0.0;
  std::vector<double> before;
  while (link_.now() < deadline_s) {
    if (link_.now() >= ask_s) {
      ask_s = link_.now() + kPoll_s / 2.0;
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
Result<std::optional<std::int64_t>> GrblDriver::softReset() {
  bool lost = link_.trouble().has_value();
  link_.forgiveTrouble();
  bool greeted = false;
  for (int i = 0; i < kTries && !greeted; ++i) {
    if (const Result<void> sent = link_.send(std::string_view(&kGrblSoftReset, 1)); !sent) {
      return sent.error();
    }
    const double deadline_s = link_.now() + kGreeting_s / kTries;
    while (!greeted && link_.now() < deadline_s) {
      const Result<std::optional<GrblMessage>> message = link_.receive(kSlice_s);
      if (!message) return message.error();
      if (!*message) continue;
      lost |= (*message)->kind == GrblMessage::Kind::kAlarm;
      greeted = (*message)->kind == GrblMessage::Kind::kBanner;
    }
  }
  if (const Result<void> quiet = link_.drain(); !quiet) return quiet.error();
  link_.forgiveTrouble();
  const Result<GrblStatus> status = this->status({});
  if (!status) return status.error();
  const Result<std::int64_t> steps = stepsIn(*status);
  if (!steps) return steps.error();
  stands_at_ = *steps;
  if (lost || !greeted) return std::optional<std::int64_t>();
  return std::optional<std::int64_t>(*steps);
}

// $SLP switches the motor off until the next reset, and writes no setting.
Result<void> GrblDriver::release() {
  const Result<void> asleep = link_.command("$SLP", kReply_s, {});
  if (asleep) locked_ = slept_ = true;
  return asleep;
}

Result<bool> GrblDriver::forgiveTrouble() {
  if (const Result<void> quiet = link_.drain(); !quiet) return quiet.error();
  const bool trouble = link_.trouble().has_value();
  if (link_.needsReset()) {
    if (const auto reset = softReset(); !reset) return reset.error();
  }
  link_.forgiveTrouble();
  return trouble;
}

}  // namespace gyre
