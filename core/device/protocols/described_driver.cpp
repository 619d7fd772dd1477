// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/described_driver.h"

#include <cmath>

#include "core/base/formatted.h"

namespace gyre {
namespace {

using Unit = TurntableDescription::Unit;

bool has(std::string_view line, const std::string& part) {
  return !part.empty() && line.find(part) != std::string_view::npos;
}

std::string filledIn(std::string text, const std::string& place, const std::string& value) {
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at)) {
    text.replace(at, place.size(), value);
    at += value.size();
  }
  return text;
}

}  // namespace

BiteDriver::Sign DescribedDriver::signOf(std::string_view line) const {
  if (has(line, description_.refused)) return Sign::kRefused;
  if (has(line, awaited_)) return Sign::kDone;
  if (has(line, description_.busy)) return Sign::kBusy;
  return has(line, description_.greeting) ? Sign::kRestart : Sign::kOther;
}

Result<void> DescribedDriver::exchange(const TurntableExchange& words, double timeout_s,
                                       const Interrupted& interrupted) {
  if (words.send.empty()) return {};
  awaited_ = words.answer;
  return obey(words.send, timeout_s, interrupted);
}

Result<void> DescribedDriver::introduce(const std::string& greeting,
                                        const Interrupted& interrupted) {
  if (description_.ask.send.empty()) {
    return greeting.empty() ? wrongDevice(description_.name) : Result<void>();
  }
  const auto names_itself = [this](std::string_view line) {
    return has(line, description_.ask.answer);
  };
  const Result<std::string> answer =
      ask(description_.ask.send, names_itself, kReply_s, interrupted);
  if (!answer && answer.error().code == Error::Code::kTimeout) {
    return wrongDevice(description_.name);
  }
  if (!answer) return answer.error();
  return {};
}

Result<TableMotor> DescribedDriver::motorFor(const TurntableOptions& options) const {
  if (description_.unit == Unit::kSteps) {
    return stepCountingMotor(description_.name, options, description_.units_per_turn,
                             description_.units_per_turn);
  }
  TableMotor motor;
  motor.firmware = description_.name;
  motor.units_per_turn = unitsPerTurn(options, description_.units_per_turn);
  motor.steps_per_turn = std::round(motor.units_per_turn * std::pow(10.0, description_.decimals));
  return motor;
}

std::string DescribedDriver::number(std::int64_t steps) const {
  const auto told = static_cast<double>(description_.direction * steps);
  const bool degrees = description_.unit == Unit::kDegrees;
  const double per_step = degrees ? motor().units_per_turn / motor().steps_per_turn : 1.0;
  return formatted("%.*f", degrees ? description_.decimals : 0, told * per_step);
}

Result<void> DescribedDriver::turn(std::int64_t from, std::int64_t by,
                                   const Interrupted& interrupted) {
  const double speed = options().speed_deg_per_s * motor().units_per_turn / 360.0;
  std::string line = filledIn(description_.move, "{by}", number(by));
  line = filledIn(line, "{to}", number(from + by));
  line = filledIn(line, "{speed}", formatted("%.0f", std::max(1.0, speed)));
  return exchange({line, description_.done}, biteDeadline_s(by), interrupted);
}

Result<void> DescribedDriver::settle(double timeout_s, const Interrupted& interrupted) {
  const TurntableExchange& words =
      description_.stop.send.empty() ? description_.ask : description_.stop;
  return exchange(words, timeout_s, interrupted);
}

Result<void> DescribedDriver::energise(std::int64_t, const Interrupted& interrupted) {
  return exchange(description_.motor_on, kReply_s, interrupted);
}

Result<void> DescribedDriver::letGo() {
  if (description_.motor_off.send.empty()) return BiteDriver::letGo();
  return exchange(description_.motor_off, kReply_s, {});
}

}  // namespace gyre
