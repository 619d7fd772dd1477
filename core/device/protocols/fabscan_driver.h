// Turns a table by the FabScan firmware.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"

namespace gyre {

// The firmware repeats every character, obeys, and says ">" when it has: a true sign of arrival.
// It counts whole motor steps (anything after the digits is ignored) and its words must stand
// apart. It never tells its steps per turn, and its restart cannot be heard. 57600 baud.
//
// Source: mariolukas/FabScanPi-Firmware, Interpreter.cpp, MotorDriver.cpp.
class FabScanDriver final : public BiteDriver {
 public:
  explicit FabScanDriver(std::unique_ptr<BytePort> port)
      : BiteDriver(std::move(port), {.send_end = "\n", .ends = "\r\n", .prompt = '>'}) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> prepare(std::int64_t from, const Interrupted& interrupted) override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;
  Result<void> energise(std::int64_t at, const Interrupted& interrupted) override;
  Result<void> letGo() override;
  std::int64_t biteOf(std::int64_t way) const override;

  std::string firmware_;
};

}  // namespace gyre
