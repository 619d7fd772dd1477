// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/comxim_driver.h"

#include <cmath>
#include <cstdlib>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr double kQuestion_s = 1.0;
constexpr double kPerUnit = 10.0;  // what is counted as a step: a tenth of a degree
// What the manual calls the direction.
constexpr int kCounterClockwise = 1;
constexpr int kClockwise = 0;

}  // namespace

BiteDriver::Sign ComXimDriver::signOf(std::string_view line) const {
  if (line == "CR+EVENT=TB_END") return turning_ ? Sign::kDone : Sign::kOther;
  if (line == "CR+OK") return turning_ ? Sign::kOther : Sign::kDone;
  return line.starts_with("CR+ERR") || line.starts_with("CR+FAIL") ? Sign::kRefused : Sign::kOther;
}

Result<void> ComXimDriver::introduce(const std::string&, const Interrupted& interrupted) {
  turning_ = false;
  const auto answers = [](std::string_view line) { return line.starts_with("CR+"); };
  const Result<std::string> answer = ask("CT();", answers, kQuestion_s, interrupted);
  if (!answer && answer.error().code == Error::Code::kTimeout) return wrongDevice("ComXim");
  if (!answer) return answer.error();
  return {};
}

Result<TableMotor> ComXimDriver::motorFor(const TurntableOptions& options) const {
  TableMotor motor;
  motor.firmware = "ComXim";
  motor.units_per_turn = options.units_per_turn;
  motor.steps_per_turn = std::round(options.units_per_turn * kPerUnit);
  return motor;
}

Result<void> ComXimDriver::turn(std::int64_t, std::int64_t by, const Interrupted& interrupted) {
  turning_ = true;
  const auto tenths = static_cast<double>(std::abs(by));
  const Result<void> turned =
      obey(formatted("CT+TRUNSINGLE(%d,%.1f);", by > 0 ? kCounterClockwise : kClockwise,
                     tenths / kPerUnit),
           biteDeadline_s(by), interrupted);
  if (turned) turning_ = false;
  return turned;
}

// Being told to stop, it stops, if it has not already.
Result<void> ComXimDriver::settle(double timeout_s, const Interrupted& interrupted) {
  turning_ = false;
  return obey("CT+SETSTOP();", timeout_s, interrupted);
}

}  // namespace gyre
