// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/bite_driver.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr int kTries = 3;
constexpr double kSlice_s = 0.02;
constexpr double kQuiet_s = 0.03;
constexpr double kLongestDrain_s = 0.5;
constexpr double kBite_s = 0.5;
constexpr double kSpareTime_s = 5.0;  // beyond twice what a bite should take
constexpr std::size_t kSaidKept = 100;
constexpr double kLongestBusy_s = 120.0;  // however often a board says that it is busy

Error silence(const std::string& port) {
  return {Error::Code::kTimeout, "The turntable on " + port + " does not answer.",
          "Check its power and its cable, then connect again."};
}

Error refused(const std::string& line) {
  return {Error::Code::kRejected, "The turntable refuses to obey (\"" + line + "\").",
          "Connect again, and look at the firmware's settings."};
}

Error notWhereLeft() {
  return {Error::Code::kAlarm, "The table is not where it was left, by its board's count.",
          "Bring it to a known position and set the angle anew."};
}

}  // namespace

// Keeps what must not be overlooked, whoever waits for the line.
Result<std::optional<std::string>> BiteDriver::hear(double timeout_s) {
  Result<std::optional<std::string>> line = link_.receive(timeout_s);
  if (!line || !*line) return line;
  const Sign sign = signOf(**line);
  if (sign == Sign::kRestart && !trouble_) {
    trouble_ = Error{Error::Code::kAlarm, "The turntable's board has restarted.",
                     "Check its power and its cable."};
  } else if (sign == Sign::kAlarm) {
    trouble_ =
        Error{Error::Code::kAlarm, "The turntable has stopped by itself (\"" + **line + "\").",
              "Remove the cause, then set the angle anew."};
  } else if (sign == Sign::kDone && unanswered_ > 0) {
    --unanswered_;
  } else if (said_.size() < kSaidKept) {
    said_.push_back(**line);
  }
  return line;
}

Result<void> BiteDriver::drain() {
  const double end_s = link_.now() + kLongestDrain_s;
  while (link_.now() < end_s) {
    const auto line = hear(kQuiet_s);
    if (!line) return line.error();
    if (!*line) break;
  }
  unanswered_ = 0;
  return {};
}

Result<std::string> BiteDriver::awaitGreeting(double greeting_s, const Interrupted& interrupted) {
  const double deadline_s = link_.now() + greeting_s;
  while (link_.now() < deadline_s) {
    if (interrupted && interrupted()) return cancelled();
    const auto line = hear(kSlice_s);
    if (!line) return line.error();
    if (*line && signOf(**line) == Sign::kRestart) return **line;
  }
  return std::string();
}

Result<void> BiteDriver::identify(double greeting_s, const Interrupted& interrupted) {
  const Result<std::string> greeting = awaitGreeting(greeting_s, interrupted);
  if (!greeting) return greeting.error();
  if (const Result<void> quiet = drain(); !quiet) return quiet;
  trouble_.reset();
  if (const Result<void> known = introduce(*greeting, interrupted); !known) return known;
  trouble_.reset();
  place_ = under_way_ = 0;
  energised_ = false;
  return {};
}

Result<TableMotor> BiteDriver::setUp(const TurntableOptions& options) {
  Result<TableMotor> motor = motorFor(options);
  if (!motor) return motor;
  options_ = options;
  motor_ = *motor;
  return motor;
}

Result<std::int64_t> BiteDriver::place(const Interrupted& interrupted) {
  const Result<std::optional<std::int64_t>> told = askPlace(interrupted);
  if (!told) return told.error();
  if (*told) place_ = **told;
  return place_;
}

Result<void> BiteDriver::makeReady(std::int64_t expected, const Interrupted& interrupted) {
  if (const Result<void> quiet = drain(); !quiet) return quiet;
  if (trouble_) return *trouble_;
  const Result<std::optional<std::int64_t>> told = askPlace(interrupted);
  if (!told) return told.error();
  if (told->value_or(place_) != expected) return notWhereLeft();
  place_ = expected;
  if (energised_) return {};
  const Result<void> ready = energise(place_, interrupted);
  energised_ = ready.ok();
  return ready;
}

double BiteDriver::bite_s(std::int64_t steps) const {
  return std::abs(static_cast<double>(steps)) / motor_.steps_per_turn * 360.0 /
         options_.speed_deg_per_s;
}

double BiteDriver::biteDeadline_s(std::int64_t steps) const {
  return 2.0 * bite_s(steps) + kSpareTime_s;
}

Result<std::int64_t> BiteDriver::travel(std::span<const std::int64_t> places,
                                        const Interrupted& interrupted) {
  const auto most = std::max<std::int64_t>(
      1, std::llround(kBite_s * options_.speed_deg_per_s / 360.0 * motor_.steps_per_turn));
  for (const std::int64_t target : places) {
    while (place_ != target) {
      if (interrupted && interrupted()) return cancelled();
      if (const Result<void> ready = prepare(place_, interrupted); !ready) return ready.error();
      under_way_ = biteOf(std::clamp(target - place_, -most, most));
      if (const Result<void> turned = turn(place_, under_way_, interrupted); !turned) {
        if (turned.error().code == Error::Code::kRejected) under_way_ = 0;
        return turned.error();
      }
      place_ += std::exchange(under_way_, 0);
    }
  }
  const Result<std::optional<std::int64_t>> told = askPlace({});
  if (!told) return told.error();
  place_ = told->value_or(place_);
  return place_;
}

// The bite under way is the last one: its end is waited for.
Result<std::optional<std::int64_t>> BiteDriver::halt() {
  const std::int64_t by = std::exchange(under_way_, 0);
  if (trouble_) {  // a board that has restarted or is in alarm stands, somewhere
    energised_ = false;
    trouble_.reset();
    return std::optional<std::int64_t>();
  }
  const double wait_s = 2.0 * bite_s(by) + kReply_s;
  const double begin_s = link_.now();
  const Interrupted too_long = [&] { return link_.now() > begin_s + 3.0 * wait_s; };
  const bool heard_end = by != 0 && unanswered_ > 0 && awaitDone("", wait_s, too_long).ok();
  if (trouble_) return std::optional<std::int64_t>();
  if (by == 0 && unanswered_ == 0) return std::optional<std::int64_t>(place_);
  if (const Result<void> quiet = drain(); !quiet) return quiet.error();
  if (const Result<void> stands = settle(wait_s, too_long); !stands) {
    if (trouble_) return std::optional<std::int64_t>();
    return stands.error();
  }
  const Result<std::optional<std::int64_t>> told = askPlace({});
  if (!told) return told.error();
  if (*told) {
    place_ = **told;
  } else if (heard_end || by == 0) {
    place_ += by;
  } else {
    return std::optional<std::int64_t>();
  }
  return std::optional<std::int64_t>(place_);
}

Result<void> BiteDriver::release() {
  const Result<void> released = letGo();
  if (released) energised_ = false;
  return released;
}

Result<void> BiteDriver::letGo() {
  return Error{Error::Code::kRejected, "This firmware cannot switch its motor off.",
               "Switch off the motor's power when you have finished."};
}

Result<bool> BiteDriver::forgiveTrouble() {
  if (const Result<void> quiet = drain(); !quiet) return quiet.error();
  const bool trouble = trouble_.has_value();
  if (trouble) energised_ = false;
  trouble_.reset();
  return trouble;
}

Result<void> BiteDriver::obey(const std::string& line, double timeout_s,
                              const Interrupted& interrupted) {
  const std::string on_wire = wrapped(line);
  if (const Result<void> sent = link_.send(on_wire); !sent) return sent;
  ++unanswered_;
  said_.clear();
  return awaitDone(on_wire, timeout_s, interrupted);
}

Result<void> BiteDriver::obeyBarrier(const std::string& line, double timeout_s,
                                     const Interrupted& interrupted) {
  for (int i = 0; i < kTries; ++i) {
    const Result<void> ended = obey(line, timeout_s, interrupted);
    if (ended || ended.error().code != Error::Code::kRejected) return ended;
    if (const Result<void> quiet = drain(); !quiet) return quiet;
  }
  return Error{Error::Code::kIo, "The turntable does not understand what it is told.",
               "Use a shorter or better shielded cable, then set the angle anew."};
}

Result<void> BiteDriver::awaitDone(const std::string& line, double timeout_s,
                                   const Interrupted& interrupted) {
  const double begin_s = link_.now();
  double deadline_s = begin_s + timeout_s;
  bool say_again = false;
  bool busy = false;
  int tries = 1;
  while (link_.now() < std::min(deadline_s, begin_s + kLongestBusy_s)) {
    if (interrupted && interrupted()) return cancelled();
    const auto heard = hear(kSlice_s);
    if (!heard) return heard.error();
    if (trouble_) return *trouble_;
    if (!*heard) continue;
    switch (signOf(**heard)) {
      case Sign::kBusy:
        busy = true;
        deadline_s = link_.now() + timeout_s;
        break;
      case Sign::kResend:
        say_again = !line.empty() && tries < kTries;
        if (!say_again) return refused(**heard);
        break;
      case Sign::kRefused:
        unanswered_ = std::max(0, unanswered_ - 1);
        return refused(**heard);
      case Sign::kDone:
        if (std::exchange(say_again, false)) {  // done with refusing it
          ++tries;
          ++unanswered_;
          if (const Result<void> sent = link_.send(line); !sent) return sent;
        } else if (unanswered_ == 0) {
          return {};
        }
        break;
      default:
        break;
    }
  }
  if (busy) {
    return Error{Error::Code::kBusy, "The turntable says that it is busy with something else.",
                 "Let it finish, then go on."};
  }
  return silence(link_.name());
}

Result<void> BiteDriver::listen(double seconds, const Interrupted& interrupted) {
  const double end_s = link_.now() + seconds;
  while (link_.now() < end_s) {
    if (interrupted && interrupted()) return cancelled();
    if (const auto heard = hear(kSlice_s); !heard) return heard.error();
  }
  return {};
}

Result<std::string> BiteDriver::ask(const std::string& line, const IsAnswer& is_answer,
                                    double timeout_s, const Interrupted& interrupted) {
  for (int i = 0; i < kTries; ++i) {
    if (const Result<void> quiet = drain(); !quiet) return quiet.error();
    if (const Result<void> sent = link_.send(wrapped(line)); !sent) return sent.error();
    said_.clear();
    const double begin_s = link_.now();
    double deadline_s = begin_s + timeout_s;
    while (link_.now() < std::min(deadline_s, begin_s + kLongestBusy_s)) {
      if (interrupted && interrupted()) return cancelled();
      const auto heard = hear(kSlice_s);
      if (!heard) return heard.error();
      if (*heard && is_answer(**heard)) return **heard;
      if (*heard && signOf(**heard) == Sign::kBusy) deadline_s = link_.now() + timeout_s;
    }
  }
  return silence(link_.name());
}

Error BiteDriver::wrongDevice(const std::string& firmware) const {
  const std::string heard = link_.heard();
  if (heard.empty()) {
    return {Error::Code::kTimeout, "Nothing answers on " + link_.name() + ".",
            "Check that the board has power and that this is its port."};
  }
  return {Error::Code::kWrongDevice,
          "The device on " + link_.name() + " does not speak " + firmware + "; it says \"" +
              heard.substr(heard.size() > 60 ? heard.size() - 60 : 0) + "\".",
          "Choose another port or firmware."};
}

std::optional<double> numberAfter(std::string_view line, std::string_view mark) {
  const std::size_t at = line.rfind(mark);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = line.substr(at + mark.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  double value = 0.0;
  const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (parsed.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double unitsPerTurn(const TurntableOptions& options, double usual) {
  constexpr double kNotSaid = 360.0;
  return options.turning_measured || options.units_per_turn != kNotSaid ? options.units_per_turn
                                                                        : usual;
}

TableMotor stepCountingMotor(std::string firmware, const TurntableOptions& options,
                             std::optional<double> told, double usual) {
  TableMotor motor;
  motor.firmware = std::move(firmware);
  const double otherwise =
      options.steps_per_turn > 0.0 ? options.steps_per_turn : told.value_or(usual);
  motor.units_per_turn = motor.steps_per_turn = unitsPerTurn(options, otherwise);
  const bool known = told.has_value() || options.steps_per_turn > 0.0 || options.turning_measured ||
                     motor.steps_per_turn != usual;
  if (!known) {
    motor.hindrances.push_back("The firmware does not tell its steps per turn; " +
                               formatted("%g", usual) +
                               " are taken until a calibration has measured them.");
  }
  return motor;
}

}  // namespace gyre
