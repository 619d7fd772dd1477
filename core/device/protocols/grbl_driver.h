// Turns a table by GRBL 1.1, grblHAL or FluidNC.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

#include "core/device/byte_port.h"
#include "core/device/protocols/grbl_handshake.h"
#include "core/device/protocols/grbl_link.h"
#include "core/device/table_driver.h"
#include "core/device/turntable_axis.h"

namespace gyre {

// Counts motor steps from the board's own position reports. Moves are sent as machine positions, so
// that a line spoilt on the wire can simply be sent again; "ok" is never taken for arrival: only
// Idle at the target is. Firmware settings are read, never written. When the port vanishes, the one
// move that the board has been given goes on.
//
// A board is locked when it starts with homing on, after an alarm, and when it wakes from the sleep
// in which release() leaves it. The lock is lifted with a person's word only; an alarm voids that.
class GrblDriver final : public TableDriver {
 public:
  explicit GrblDriver(std::unique_ptr<BytePort> port) : link_(std::move(port)) {}

  Result<void> identify(double greeting_s, const Interrupted& interrupted) override;
  Result<TableMotor> setUp(const TurntableOptions& options) override;
  Result<std::int64_t> place(const Interrupted& interrupted) override;
  Result<void> makeReady(std::int64_t expected, const Interrupted& interrupted) override;
  Result<std::int64_t> travel(std::span<const std::int64_t> places,
                              const Interrupted& interrupted) override;
  Result<std::optional<std::int64_t>> halt() override;
  Result<void> release() override;
  const std::optional<Error>& trouble() const override { return link_.trouble(); }
  Result<bool> forgiveTrouble() override;
  std::optional<Error> lock() const override;
  void allowUnlock() override { alarms_at_word_ = link_.alarms(); }
  std::string portName() const override { return link_.name(); }

 private:
  bool mayUnlock() const { return alarms_at_word_ == link_.alarms(); }
  Result<GrblStatus> status(const Interrupted& interrupted);
  Result<void> wake(const GrblStatus& status, const Interrupted& interrupted);
  Result<void> sendMove(std::int64_t target, const Interrupted& interrupted);
  Result<std::int64_t> awaitArrival(std::int64_t target, double timeout_s,
                                    const Interrupted& interrupted);
  Result<void> awaitStandstill();
  Result<std::optional<std::int64_t>> softReset();
  bool standsAt(const GrblStatus& status, std::int64_t steps) const;
  Result<std::int64_t> stepsIn(const GrblStatus& status) const;
  double secondsFor(std::int64_t way_steps) const;

  GrblLink link_;
  GrblBoardInfo board_;
  TurntableAxis axis_;
  std::int64_t stands_at_ = 0;         // at the last confirmed standstill
  bool locked_ = false;                // by the last status, or as release() will have left it
  bool slept_ = false;                 // release() put the board to sleep
  std::optional<int> alarms_at_word_;  // when a person last allowed that it is unlocked
};

}  // namespace gyre
