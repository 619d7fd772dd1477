// Turns a table by the Sardauscan firmware.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"

namespace gyre {

// Tells its own steps per turn. A move is answered after the motion, with what was understood and
// where the table stands. The motor is always on.
//
// Source: Sardau/Sardauscan, FirmWare.ino.
class SardauscanDriver final : public BiteDriver {
 public:
  explicit SardauscanDriver(std::unique_ptr<BytePort> port) : BiteDriver(std::move(port), {}) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> prepare(std::int64_t from, const Interrupted& interrupted) override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;
  std::int64_t biteOf(std::int64_t way) const override;
  Result<std::optional<std::int64_t>> askPlace(const Interrupted& interrupted) override;

  std::string firmware_;
  double steps_per_turn_ = 0.0;
  std::int64_t zero_ = 0;  // our count where the firmware's is 0
};

}  // namespace gyre
