// Turns a table by the Horus firmware of the Ciclop scanner: GRBL 0.9 with words of its own.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"

namespace gyre {

// "ok" to a move comes when it is planned. To switch a laser off, the firmware first waits until
// all motion has ended: that is the sign of arrival. Positions are absolute, in degrees.
//
// Source: LibreScanner/horus-fw, report.c, gcode.c, laser_control.c.
class HorusDriver final : public BiteDriver {
 public:
  explicit HorusDriver(std::unique_ptr<BytePort> port) : BiteDriver(std::move(port), {}) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;
  Result<void> energise(std::int64_t at, const Interrupted& interrupted) override;
  Result<void> letGo() override;

  std::string firmware_;
  std::int64_t zero_ = 0;                   // our count where the firmware's is 0
  std::optional<double> steps_per_degree_;  // $100, where it is told
};

}  // namespace gyre
