// Turns a table as its owner's description says.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/device/protocols/bite_driver.h"
#include "core/scan/turntable_description.h"

namespace gyre {

class DescribedDriver final : public BiteDriver {
 public:
  DescribedDriver(std::unique_ptr<BytePort> port, TurntableDescription description)
      : BiteDriver(std::move(port),
                   {.send_end = description.line_end, .ends = description.answer_ends}),
        description_(std::move(description)) {}

 private:
  Sign signOf(std::string_view line) const override;
  Result<void> introduce(const std::string& greeting, const Interrupted& interrupted) override;
  Result<TableMotor> motorFor(const TurntableOptions& options) const override;
  Result<void> turn(std::int64_t from, std::int64_t by, const Interrupted& interrupted) override;
  Result<void> settle(double timeout_s, const Interrupted& interrupted) override;
  Result<void> energise(std::int64_t at, const Interrupted& interrupted) override;
  Result<void> letGo() override;

  Result<void> exchange(const TurntableExchange& words, double timeout_s,
                        const Interrupted& interrupted);
  std::string number(std::int64_t steps) const;

  TurntableDescription description_;
  std::string awaited_;  // part of the line that ends the exchange
};

}  // namespace gyre
