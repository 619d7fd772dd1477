// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/marlin_driver.h"

#include <cmath>
#include <cstdlib>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr double kQuestion_s = 3.0;
// A board that is busy says so every two seconds (M113).
constexpr double kAnswer_s = 3.0;
constexpr double kLookAgain_s = 0.3;                  // in which a machine at work has moved
constexpr double kFarthest_steps = 0.25 * (1 << 23);  // float32 positions
// Steps per unit are told with two decimals: within what that hides, a whole number a turn is
// meant, and the motor's count may differ by a step or two from ours after several turns.
constexpr double kHiddenPerUnit = 0.005;
constexpr std::int64_t kRounding_steps = 2;

bool contains(std::string_view line, std::string_view part) {
  return line.find(part) != std::string_view::npos;
}

// The motor's count of an axis in "X:1.00 Y:0.00 Z:0.00 E:0.00 Count X:9 Y:0 Z:0".
std::optional<double> countIn(std::string_view report, char axis) {
  const std::size_t count = report.find("Count");
  if (count == std::string_view::npos) return std::nullopt;
  return numberAfter(report.substr(count), std::string{axis, ':'});
}

}  // namespace

BiteDriver::Sign MarlinDriver::signOf(std::string_view line) const {
  if (line == "ok" || line.starts_with("ok ")) return Sign::kDone;
  if (contains(line, "busy:")) return Sign::kBusy;
  if (line.starts_with("Resend:") || line.starts_with("rs ")) return Sign::kResend;
  if (line == "start") return Sign::kRestart;
  if (contains(line, "halted") || contains(line, "kill()") || line == "!!") return Sign::kAlarm;
  // What was heard wrong is asked for again in the next line.
  const bool misheard = contains(line, "hecksum") || contains(line, "Line Number");
  const bool wrong = line.starts_with("Error:") || line.starts_with("echo:Unknown command");
  return wrong && !misheard ? Sign::kRefused : Sign::kOther;
}

std::string MarlinDriver::wrapped(const std::string& line) {
  if (line_number_ < 0) return line;
  const std::string numbered = "N" + std::to_string(++line_number_) + " " + line;
  unsigned sum = 0;
  for (const char c : numbered) sum ^= static_cast<unsigned char>(c);
  return numbered + "*" + std::to_string(sum);
}

// A number that got lost on the wire must not spoil the next line.
Result<void> MarlinDriver::prepare(std::int64_t, const Interrupted& interrupted) {
  line_number_ = -1;
  const Result<void> done = obey("M110 N0", kAnswer_s, interrupted);
  if (done) line_number_ = 0;
  return done;
}

Result<std::string> MarlinDriver::report(const Interrupted& interrupted) {
  line_number_ = -1;
  return ask(
      "M114", [](std::string_view line) { return contains(line, "X:"); }, kQuestion_s, interrupted);
}

Result<void> MarlinDriver::introduce(const std::string&, const Interrupted& interrupted) {
  line_number_ = -1;
  const auto names_itself = [](std::string_view line) { return contains(line, "FIRMWARE_NAME:"); };
  const Result<std::string> name = ask("M115", names_itself, kQuestion_s, interrupted);
  if (!name && name.error().code == Error::Code::kTimeout) return wrongDevice("Marlin");
  if (!name) return name.error();
  if (!contains(*name, "Marlin")) return wrongDevice("Marlin");
  const std::size_t begin = name->find("FIRMWARE_NAME:") + std::string("FIRMWARE_NAME:").size();
  firmware_ =
      name->substr(begin, std::min(name->find(" (", begin), name->find(" SOURCE", begin)) - begin);
  const Result<std::string> first = report(interrupted);
  if (!first) return first.error();
  if (const Result<void> waited = listen(kLookAgain_s, interrupted); !waited) return waited;
  const Result<std::string> second = report(interrupted);
  if (!second) return second.error();
  if (*first != *second) {
    return Error{Error::Code::kBusy, "The board on " + portName() + " is moving already.",
                 "Stop what drives it, then connect again."};
  }
  if (const Result<void> read = readSettings(interrupted); !read) return read;
  zero_report_ = *second;
  commanded_ = 0;
  return {};
}

// What may be missing in a firmware built without it.
Result<void> MarlinDriver::readSettings(const Interrupted& interrupted) {
  const auto tells_steps = [](std::string_view line) { return contains(line, "M92 X"); };
  const Result<std::string> steps = ask("M503", tells_steps, kQuestion_s, interrupted);
  if (!steps && steps.error().code != Error::Code::kTimeout) return steps.error();
  steps_line_ = steps ? steps->substr(steps->find("M92")) : "";
  const auto tells_limits = [](std::string_view line) {
    return contains(line, "M211") || contains(line, "oft endstops");
  };
  const Result<std::string> limits = ask("M211", tells_limits, kQuestion_s, interrupted);
  if (!limits && limits.error().code != Error::Code::kTimeout) return limits.error();
  soft_endstops_ =
      limits && (contains(*limits, "S1") || contains(*limits, ": On") || contains(*limits, ": ON"));
  return {};
}

Result<TableMotor> MarlinDriver::motorFor(const TurntableOptions& options) const {
  TableMotor motor;
  motor.firmware = firmware_;
  motor.units_per_turn = options.units_per_turn;
  motor.farthest_steps = kFarthest_steps;
  const auto told = numberAfter(steps_line_, std::string{' ', options.axis.front()});
  if (options.steps_per_turn > 0.0) {
    motor.steps_per_turn = options.steps_per_turn;
  } else if (told.value_or(0.0) > 0.0) {
    const double steps = *told * options.units_per_turn;
    const double whole = std::round(steps);
    motor.steps_per_turn =
        std::abs(steps - whole) <= kHiddenPerUnit * options.units_per_turn ? whole : steps;
  } else {
    return Error{Error::Code::kRejected,
                 "The board does not tell the steps of its axis " + options.axis + ".",
                 "Choose another axis, or give the steps per turn."};
  }
  if (soft_endstops_) {
    motor.hindrances.emplace_back(
        "Soft endstops are on: the table stops before a full turn: send M211 S0.");
  }
  return motor;
}

Result<void> MarlinDriver::energise(std::int64_t at, const Interrupted& interrupted) {
  commanded_ = at;
  line_number_ = -1;
  for (const char* line : {"M17", "G90", "G21"}) {
    if (const Result<void> done = obey(line, kAnswer_s, interrupted); !done) return done;
  }
  const Result<std::string> here = report(interrupted);
  if (!here) return here.error();
  // Where the table stands becomes what we count: no homing, and no position of a former user.
  const double units =
      static_cast<double>(commanded_) / motor().steps_per_turn * motor().units_per_turn;
  const Result<void> set = obey(formatted("G92 %c%.4f", axis(), units), kAnswer_s, interrupted);
  if (!set) return set;
  const Result<std::string> after = report(interrupted);
  if (!after) return after.error();
  // Whether G92 changes the motor's own count differs between versions.
  const auto count = countIn(*after, axis());
  zero_report_ =
      count ? formatted("Count %c:%.0f", axis(), *count - static_cast<double>(commanded_)) : "";
  return {};
}

Result<void> MarlinDriver::turn(std::int64_t from, std::int64_t by,
                                const Interrupted& interrupted) {
  const double per_step = motor().units_per_turn / motor().steps_per_turn;
  const double feed_per_min = options().speed_deg_per_s * motor().units_per_turn / 360.0 * 60.0;
  commanded_ = from + by;
  const Result<void> planned =
      obey(formatted("G1 %c%.4f F%.1f", axis(), static_cast<double>(commanded_) * per_step,
                     feed_per_min),
           kAnswer_s, interrupted);
  if (!planned) return planned;
  return obeyBarrier("M400", biteDeadline_s(by), interrupted);
}

Result<void> MarlinDriver::settle(double timeout_s, const Interrupted& interrupted) {
  line_number_ = -1;
  return obeyBarrier("M400", timeout_s, interrupted);
}

Result<void> MarlinDriver::letGo() {
  line_number_ = -1;
  return obey("M84", kAnswer_s, {});
}

Result<std::optional<std::int64_t>> MarlinDriver::askPlace(const Interrupted& interrupted) {
  const Result<std::string> now = report(interrupted);
  if (!now) return now.error();
  const auto count = countIn(*now, axis());
  const auto zero = countIn(zero_report_, axis());
  if (!count || !zero) return std::optional<std::int64_t>();
  const auto told = static_cast<std::int64_t>(std::llround(*count - *zero));
  if (std::abs(told - commanded_) <= kRounding_steps) return std::optional(commanded_);
  return std::optional(told);
}

}  // namespace gyre
