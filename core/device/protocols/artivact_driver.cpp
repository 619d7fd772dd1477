// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/artivact_driver.h"

#include <algorithm>
#include <cstdlib>

namespace gyre {
namespace {

constexpr double kQuestion_s = 1.0;
constexpr std::int64_t kSteps = 12288;  // of one turn, by the firmware
constexpr const char* kVersion = "ARTIVACT_TT_V2";

}  // namespace

BiteDriver::Sign ArtivactDriver::signOf(std::string_view line) const {
  if (line == "OK") return Sign::kDone;
  return line == "ERR" ? Sign::kRefused : Sign::kOther;
}

Result<void> ArtivactDriver::introduce(const std::string&, const Interrupted& interrupted) {
  const auto names_itself = [](std::string_view line) { return line == kVersion; };
  const Result<std::string> answer = ask("VERSION", names_itself, kQuestion_s, interrupted);
  if (!answer && answer.error().code == Error::Code::kTimeout) return wrongDevice("Artivact");
  if (!answer) return answer.error();
  return {};
}

Result<TableMotor> ArtivactDriver::motorFor(const TurntableOptions& options) const {
  constexpr auto kTold = static_cast<double>(kSteps);
  return stepCountingMotor("Artivact turntable 2", options, kTold, kTold);
}

// The longest move of "MOVE n" within the way: 12288 / n <= |way|, the remainder dropped.
std::int64_t ArtivactDriver::biteOf(std::int64_t way) const {
  const std::int64_t most = std::min(std::abs(way), kSteps);
  std::int64_t divisor = kSteps / most;
  if (kSteps / divisor > most) ++divisor;
  const std::int64_t steps = kSteps / divisor;
  return way < 0 ? -steps : steps;
}

Result<void> ArtivactDriver::turn(std::int64_t, std::int64_t by, const Interrupted& interrupted) {
  // by came from biteOf(): some divisor gives it exactly, and the largest such is kSteps / |by|.
  return obey("MOVE " + std::to_string(kSteps / by), biteDeadline_s(by), interrupted);
}

Result<void> ArtivactDriver::settle(double timeout_s, const Interrupted& interrupted) {
  const auto names_itself = [](std::string_view line) { return line == kVersion; };
  const Result<std::string> answer = ask("VERSION", names_itself, timeout_s, interrupted);
  if (!answer) return answer.error();
  return {};
}

}  // namespace gyre
