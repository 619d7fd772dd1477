// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/sardauscan_driver.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gyre {
namespace {

constexpr double kQuestion_s = 1.0;
// The firmware multiplies steps in 16 bits: bites stay small, and its count is set back to 0 long
// before it overflows.
constexpr std::int64_t kMostSteps = 1000;
constexpr const char* kAskPlace = "T";

std::optional<std::int64_t> wholeAfter(std::string_view line, std::string_view mark) {
  const std::optional<double> value = numberAfter(line, mark);
  if (!value) return std::nullopt;
  return std::llround(*value);
}

}  // namespace

BiteDriver::Sign SardauscanDriver::signOf(std::string_view line) const {
  if (line.starts_with("Sardauscan")) return Sign::kRestart;
  if (line.starts_with("RELATIVE ROTATION")) return Sign::kDone;
  return line == "Hun?" || line == "What?" ? Sign::kRefused : Sign::kOther;
}

Result<void> SardauscanDriver::introduce(const std::string& greeting,
                                         const Interrupted& interrupted) {
  firmware_ = greeting;
  if (firmware_.empty()) {
    const auto yes = [](std::string_view line) { return line == "yes"; };
    const Result<std::string> answer = ask("sardauscan", yes, kQuestion_s, interrupted);
    if (!answer && answer.error().code == Error::Code::kTimeout) return wrongDevice("Sardauscan");
    if (!answer) return answer.error();
    firmware_ = "Sardauscan";
  }
  const auto tells_steps = [](std::string_view line) {
    return line.starts_with("REVOLUTION STEPS");
  };
  const Result<std::string> steps = ask("T S", tells_steps, kQuestion_s, interrupted);
  if (!steps) return steps.error();
  steps_per_turn_ = numberAfter(*steps, "=>").value_or(0.0);
  if (!(steps_per_turn_ >= 1.0)) return wrongDevice("Sardauscan");
  zero_ = 0;
  const auto told = askPlace(interrupted);
  if (!told) return told.error();
  zero_ = -told->value_or(0);  // our count begins at 0 where it stands
  return {};
}

Result<TableMotor> SardauscanDriver::motorFor(const TurntableOptions& options) const {
  return stepCountingMotor(firmware_, options, steps_per_turn_, steps_per_turn_);
}

std::int64_t SardauscanDriver::biteOf(std::int64_t way) const {
  return std::clamp(way, -kMostSteps, kMostSteps);
}

Result<std::optional<std::int64_t>> SardauscanDriver::askPlace(const Interrupted& interrupted) {
  const auto tells_place = [](std::string_view line) { return line.starts_with("Position "); };
  const Result<std::string> answer = ask(kAskPlace, tells_place, kQuestion_s, interrupted);
  if (!answer) return answer.error();
  const auto place = wholeAfter(*answer, "Position ");
  if (!place) return std::optional<std::int64_t>();
  return std::optional<std::int64_t>(zero_ + *place);
}

Result<void> SardauscanDriver::prepare(std::int64_t from, const Interrupted& interrupted) {
  if (std::abs(from - zero_) <= kMostSteps) return {};
  const auto is_reset = [](std::string_view line) { return line.starts_with("RESET "); };
  const Result<std::string> reset = ask("T C", is_reset, kQuestion_s, interrupted);
  if (!reset) return reset.error();
  zero_ = from;
  return {};
}

Result<void> SardauscanDriver::turn(std::int64_t, std::int64_t by, const Interrupted& interrupted) {
  return obey("T R " + std::to_string(by), biteDeadline_s(by), interrupted);
}

Result<void> SardauscanDriver::settle(double timeout_s, const Interrupted& interrupted) {
  const auto tells_place = [](std::string_view line) { return line.starts_with("Position "); };
  const Result<std::string> answer = ask(kAskPlace, tells_place, timeout_s, interrupted);
  if (!answer) return answer.error();
  return {};
}

}  // namespace gyre
