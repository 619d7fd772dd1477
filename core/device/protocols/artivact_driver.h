// Turns a table by the firmware of Artivact's turntable, version 2.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"

namespace gyre {

// "MOVE n" turns by a turn's 12288 steps divided by n, without the remainder, and is answered after
// the motion. Any whole number of steps is put together of such moves, so that no remainder is ever
// lost. The motor is always on.
//
// Source: arassec/artivact, its turntable's sketch.
class ArtivactDriver final : public BiteDriver {
 public:
  explicit ArtivactDriver(std::unique_ptr<BytePort> port) : BiteDriver(std::move(port), {}) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;
  std::int64_t biteOf(std::int64_t way) const override;
};

}  // namespace gyre
