// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/fabscan_driver.h"

#include <algorithm>

namespace gyre {
namespace {

constexpr double kUsualSteps = 3200.0;  // there are kits with 6400
// The firmware's numbers have 16 bits.
constexpr std::int64_t kMostSteps = 32000;

}  // namespace

BiteDriver::Sign FabScanDriver::signOf(std::string_view line) const {
  return line.ends_with('>') ? Sign::kDone : Sign::kOther;
}

Result<void> FabScanDriver::introduce(const std::string&, const Interrupted& interrupted) {
  // Ends what another host has left half said.
  if (const Result<void> sent = link().sendRaw("\r\n\r\n"); !sent) return sent;
  (void)forgiveTrouble();
  const std::string question = "M200";
  const Result<void> answered = obey(question, kReply_s, interrupted);
  if (!answered && answered.error().code == Error::Code::kTimeout) return wrongDevice("FabScan");
  if (!answered) return answered;
  const auto echo = std::find(said().begin(), said().end(), question);
  if (echo == said().end()) return wrongDevice("FabScan");
  const auto version = echo + 1;
  firmware_ = "FabScan" + (version == said().end() ? "" : " " + *version);
  return {};
}

Result<TableMotor> FabScanDriver::motorFor(const TurntableOptions& options) const {
  return stepCountingMotor(firmware_, options, std::nullopt, kUsualSteps);
}

std::int64_t FabScanDriver::biteOf(std::int64_t way) const {
  return std::clamp(way, -kMostSteps, kMostSteps);
}

// The motor is off after a restart, of which nobody hears, and counts all the same.
Result<void> FabScanDriver::prepare(std::int64_t from, const Interrupted& interrupted) {
  return energise(from, interrupted);
}

Result<void> FabScanDriver::turn(std::int64_t, std::int64_t by, const Interrupted& interrupted) {
  const std::string line = "G2 T" + std::to_string(by) + " F200";
  if (const Result<void> turned = obey(line, biteDeadline_s(by), interrupted); !turned) {
    return turned;
  }
  // What was obeyed is what the firmware repeated.
  if (std::find(said().begin(), said().end(), line) != said().end()) return {};
  return Error{Error::Code::kIo, "The turntable did not hear what it was told.",
               "Use a shorter or better shielded cable, then set the angle anew."};
}

Result<void> FabScanDriver::settle(double timeout_s, const Interrupted& interrupted) {
  return obey("M200", timeout_s, interrupted);
}

Result<void> FabScanDriver::energise(std::int64_t, const Interrupted& interrupted) {
  return obey("M17", kReply_s, interrupted);
}

Result<void> FabScanDriver::letGo() {
  for (const char* laser_off : {"M20", "M22"}) {
    if (const Result<void> off = obey(laser_off, kReply_s, {}); !off) return off;
  }
  return obey("M18", kReply_s, {});
}

}  // namespace gyre
