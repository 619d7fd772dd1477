// Turns a table by Marlin, on one axis of a printer's board.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"

namespace gyre {

// "ok" to a move comes when it is planned; M400 is answered at standstill, and M114 then tells the
// motor's own count. Lines of a move carry numbers and sums, so that a spoilt one is said again.
// Nothing is homed; the place where the table stands becomes 0.
//
// Source: MarlinDocumentation _gcode/M110, M113, M114, M115, M211, M400, M503.
class MarlinDriver final : public BiteDriver {
 public:
  explicit MarlinDriver(std::unique_ptr<BytePort> port) : BiteDriver(std::move(port), {}) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> prepare(std::int64_t from, const Interrupted& interrupted) override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;
  Result<void> energise(std::int64_t at, const Interrupted& interrupted) override;
  Result<void> letGo() override;
  Result<std::optional<std::int64_t>> askPlace(const Interrupted& interrupted) override;
  std::string wrapped(const std::string& line) override;

  Result<std::string> report(const Interrupted& interrupted);
  Result<void> readSettings(const Interrupted& interrupted);
  char axis() const { return options().axis.front(); }

  std::string firmware_;
  std::string steps_line_;  // "M92 X8.89 Y80.00 ...", empty when it was not told
  bool soft_endstops_ = false;
  std::string zero_report_;  // the answer to M114 when the count became 0
  std::int64_t commanded_ = 0;
  int line_number_ = -1;  // -1: lines go out bare
};

}  // namespace gyre
