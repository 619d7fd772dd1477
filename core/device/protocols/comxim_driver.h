// Turns a ComXim table, over USB or the network.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"

namespace gyre {

// Commands and answers end with ";". A move is answered by "CR+OK;" at once and by
// "CR+EVENT=TB_END;" at its end. Angles are given in tenths of a degree. Where the table stands is
// never told, and zero is never searched for.
//
// Source: ComXim's manual, chapter on commands.
class ComXimDriver final : public BiteDriver {
 public:
  explicit ComXimDriver(std::unique_ptr<BytePort> port)
      : BiteDriver(std::move(port), {.send_end = "", .ends = ";\r\n"}) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;

  bool turning_ = false;  // the last command is answered twice
};

}  // namespace gyre
