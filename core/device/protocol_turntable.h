// A turntable driven by a GRBL board behind any port.
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
#include "core/device/protocols/grbl_handshake.h"
#include "core/device/protocols/grbl_link.h"
#include "core/device/turntable.h"
#include "core/device/turntable_axis.h"

namespace gyre {

// Counts motor steps in whole numbers, from the board's own position reports. Moves are sent as
// machine positions, so that a line spoilt on the wire can simply be sent again, and a table that
// strayed is brought to its place; "ok" is never taken for arrival: only Idle at the target is.
//
// The angle is unknown after an alarm, after the board restarted, and after release(), when a hand
// may turn the table: moveTo() then refuses with kAlarm until setAngle(). Firmware settings are
// read, never written. When the port vanishes, the one move that the board has been given goes on.
class ProtocolTurntable final : public Turntable {
 public:
  // Identifies the board (see identifyGrbl; at most about 10 s); moves nothing. The angle is 0
  // where the table stands.
  static Result<std::unique_ptr<ProtocolTurntable>> open(std::unique_ptr<BytePort> port,
                                                         const TurntableOptions& options,
                                                         const Task& task);

  Result<void> moveTo(double angle_rad, const Task& task) override;
  double angleRad() const override { return angleOf(machine_steps_); }
  std::int64_t steps() const override;
  TablePlace place() const override { return {count_, machine_steps_}; }
  std::optional<double> angleAt(const TablePlace& place) const override;
  Result<void> setAngle(double angle_rad) override;
  void stop() noexcept override { stop_requested_ = true; }
  Result<void> release() override;
  Result<void> correct(double turned_over_told) override;
  TurntableInfo info() const override { return info_; }

 private:
  enum class Outcome { kArrived, kStrayed };

  ProtocolTurntable(std::unique_ptr<BytePort> port, const TurntableOptions& options)
      : link_(std::move(port)), options_(options) {}

  Result<void> adopt(const GrblBoardInfo& board, const TurntableOptions& options);
  Result<void> makeReady(const Interrupted& interrupted);
  Result<void> wake(const GrblStatus& status, const Interrupted& interrupted);
  Result<Outcome> attempt(std::int64_t target, const Interrupted& interrupted);
  Result<void> sendMove(std::int64_t target, const Interrupted& interrupted);
  Result<Outcome> awaitArrival(std::int64_t target, double timeout_s,
                               const Interrupted& interrupted);
  Result<void> halt();
  Result<void> awaitStandstill();
  Result<void> softReset();
  Error fail(const Error& error);
  bool standsAt(const GrblStatus& status, std::int64_t machine_steps) const;
  Result<std::int64_t> machineStepsIn(const GrblStatus& status) const;
  std::int64_t stepsFor(double angle_rad) const;
  double angleOf(std::int64_t machine_steps) const;
  double secondsFor(std::int64_t way_steps) const;

  GrblLink link_;
  TurntableOptions options_;
  GrblBoardInfo board_;
  TurntableAxis axis_;
  TurntableInfo info_;
  std::int64_t machine_steps_ = 0;  // by the board's count, at the last confirmed standstill
  std::int64_t origin_steps_ = 0;   // the board's count at angle 0
  bool angle_known_ = false;
  int count_ = 0;  // grows whenever a lost angle is set anew: the board may count anew since
  std::atomic<bool> stop_requested_ = false;
};

}  // namespace gyre
