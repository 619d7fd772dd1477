// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/horus_driver.h"

#include "core/base/formatted.h"
#include "core/device/turntable_hindrances.h"

namespace gyre {
namespace {

constexpr double kQuestion_s = 0.8;
constexpr double kUsualSteps = 3200.0;  // the Ciclop kit: 200 full steps in sixteenths
constexpr double kFarthest_steps = 0.25 * (1 << 23);  // float32 degrees, as in GRBL
constexpr const char* kReset = "\x18\r\n";
constexpr const char* kBarrier = "M70T1";  // laser 1 off, once all motion has ended

}  // namespace

BiteDriver::Sign HorusDriver::signOf(std::string_view line) const {
  if (line == "ok") return Sign::kDone;
  if (line.starts_with("error")) return Sign::kRefused;
  if (line.starts_with("ALARM")) return Sign::kAlarm;
  return line.starts_with("Horus ") ? Sign::kRestart : Sign::kOther;
}

Result<void> HorusDriver::introduce(const std::string& greeting, const Interrupted& interrupted) {
  firmware_ = greeting;
  if (firmware_.empty()) {
    const auto names_itself = [](std::string_view line) { return line.starts_with("Horus "); };
    const Result<std::string> banner = ask(kReset, names_itself, kReply_s, interrupted);
    if (!banner && banner.error().code == Error::Code::kTimeout) return wrongDevice("Horus");
    if (!banner) return banner.error();
    firmware_ = *banner;
  }
  firmware_ = firmware_.substr(0, firmware_.find(" ["));
  if (firmware_ == "Horus 0.1") {
    return Error{Error::Code::kWrongDevice, "The board's firmware, Horus 0.1, is too old.",
                 "Put Horus 0.2 on it."};
  }
  (void)forgiveTrouble();
  const auto tells_steps = [](std::string_view line) { return line.starts_with("$100="); };
  const Result<std::string> steps = ask("$$", tells_steps, kQuestion_s, interrupted);
  if (!steps && steps.error().code != Error::Code::kTimeout) return steps.error();
  steps_per_degree_ = steps ? numberAfter(*steps, "$100=") : std::nullopt;
  (void)forgiveTrouble();  // takes in the rest of the list
  return {};
}

Result<TableMotor> HorusDriver::motorFor(const TurntableOptions& options) const {
  TableMotor motor;
  motor.firmware = firmware_;
  motor.units_per_turn = options.units_per_turn;
  motor.farthest_steps = kFarthest_steps;
  if (options.steps_per_turn > 0.0) {
    motor.steps_per_turn = options.steps_per_turn;
  } else if (steps_per_degree_.value_or(0.0) > 0.0) {
    motor.steps_per_turn = wholeStepsPerTurn(*steps_per_degree_, options.units_per_turn);
  } else {
    motor.steps_per_turn = kUsualSteps * options.units_per_turn / 360.0;
    motor.hindrances.emplace_back(
        "The firmware does not tell its motor's steps: 3200 in 360 of "
        "its degrees are taken.");
  }
  return motor;
}

Result<void> HorusDriver::turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) {
  const double target =
      static_cast<double>(from + by - zero_) / motor().steps_per_turn * motor().units_per_turn;
  const Result<void> planned = obey(formatted("G1X%.4f", target), kReply_s, interrupted);
  if (!planned) return planned;
  return obeyBarrier(kBarrier, biteDeadline_s(by), interrupted);
}

Result<void> HorusDriver::settle(double timeout_s, const Interrupted& interrupted) {
  return obeyBarrier(kBarrier, timeout_s, interrupted);
}

Result<void> HorusDriver::energise(std::int64_t at, const Interrupted& interrupted) {
  if (const Result<void> zero = obey("G50", kReply_s, interrupted); !zero) return zero;
  zero_ = at;
  if (const Result<void> on = obey("M17", kReply_s, interrupted); !on) return on;
  const double speed = options().speed_deg_per_s * motor().units_per_turn / 360.0;
  return obey(formatted("G1F%.2f", speed), kReply_s, interrupted);
}

Result<void> HorusDriver::letGo() {
  for (const char* line : {kBarrier, "M70T2"}) {
    if (const Result<void> off = obey(line, kReply_s, {}); !off) return off;
  }
  return obey("M18", kReply_s, {});
}

}  // namespace gyre
