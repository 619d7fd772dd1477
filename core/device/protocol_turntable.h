// A turntable driven through any firmware's own driver: angles into motor steps, and safety.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/byte_port.h"
#include "core/device/options.h"
#include "core/device/table_driver.h"
#include "core/device/turntable.h"

namespace gyre {

// Counts motor steps in whole numbers: each target is rounded from angle 0 on, so that remainders
// are carried. A table always arrives in the same direction, so that play in the gears is on the
// same side for every view.
//
// The angle is unknown after an alarm, after the board restarted, and after release(), when a hand
// may turn the table: moveTo() then refuses with kAlarm until setAngle(). Firmware settings are
// read, never written. A board that is locked is unlocked with a person's word only, which the
// options or allowUnlock() give: without it moveTo() refuses with kNoPermission, and nothing is
// sent.
class ProtocolTurntable final : public Turntable {
 public:
  // Identifies the driver's firmware, waiting at most options.greeting_s for each greeting; moves
  // nothing. The angle is 0 where the table stands.
  static Result<std::unique_ptr<ProtocolTurntable>> open(std::unique_ptr<TableDriver> driver,
                                                         const TurntableOptions& options,
                                                         const Task& task);
  // The same for a driver whose firmware has been identified already.
  static Result<std::unique_ptr<ProtocolTurntable>> adopt(std::unique_ptr<TableDriver> driver,
                                                          const TurntableOptions& options,
                                                          const Task& task);
  // A GRBL board behind the port.
  static Result<std::unique_ptr<ProtocolTurntable>> open(std::unique_ptr<BytePort> port,
                                                         const TurntableOptions& options,
                                                         const Task& task);

  Result<void> moveTo(double angle_rad, const Task& task) override;
  double angleRad() const override { return angleOf(place_steps_); }
  std::int64_t steps() const override;
  TablePlace place() const override { return {count_, place_steps_}; }
  std::optional<double> angleAt(const TablePlace& place) const override;
  Result<void> setAngle(double angle_rad) override;
  void stop() noexcept override { stop_requested_ = true; }
  Result<void> release() override;
  Result<void> correct(double turned_over_told) override;
  void setApproach(double approach_rad) override;
  double approachRad() const override;
  void allowUnlock() override { driver_->allowUnlock(); }
  TurntableInfo info() const override;

 private:
  ProtocolTurntable(std::unique_ptr<TableDriver> driver, TurntableOptions options)
      : driver_(std::move(driver)), options_(std::move(options)) {}

  Result<void> setUp(const TurntableOptions& options);
  Result<bool> attempt(std::int64_t target, const Interrupted& interrupted);
  Error fail(const Error& error);
  std::int64_t stepsFor(double angle_rad) const;
  double angleOf(std::int64_t place_steps) const;

  std::unique_ptr<TableDriver> driver_;
  TurntableOptions options_;
  TableMotor motor_;
  TurntableInfo info_;
  std::int64_t place_steps_ = 0;   // by the driver's count, at the last confirmed standstill
  std::int64_t origin_steps_ = 0;  // the driver's count at angle 0
  bool angle_known_ = false;
  int count_ = 0;  // grows whenever a lost angle is set anew: the board may count anew since
  std::atomic<bool> stop_requested_ = false;
};

}  // namespace gyre
