// A table without a motor: a person turns it to the mark that is asked for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/result.h"
#include "core/device/options.h"
#include "core/device/turntable.h"

namespace gyre {

// What the person is asked for. Angles are positive counter-clockwise, seen from above.
struct HandTurn {
  std::int64_t ticks = 0;  // by so many marks; negative: clockwise
  double to_deg = 0.0;     // the angle at which the table shall stand then, in [0, 360)
  double tick_deg = 0.0;   // between two marks
};

// Asks, and returns when the person says that the table stands there. kCancelled when the task is
// stopped meanwhile, whatever the person does.
using AskPerson = std::function<Result<void>(const HandTurn& turn, const Task& task)>;

// Its steps are the marks on the rim: options.steps_per_turn of them, 360 when that is 0. Angles
// are rounded to marks. The table is never let go of: nothing holds it but the person.
class HandTurntable final : public Turntable {
 public:
  // The table stands at the angle 0. Fails when the options are no good or nobody can be asked.
  static Result<std::unique_ptr<HandTurntable>> open(const TurntableOptions& options,
                                                     AskPerson ask);

  Result<void> moveTo(double angle_rad, const Task& task) override;
  double angleRad() const override;
  std::int64_t steps() const override { return ticks_ - origin_ticks_; }
  TablePlace place() const override { return {0, ticks_}; }
  std::optional<double> angleAt(const TablePlace& place) const override;
  Result<void> setAngle(double angle_rad) override;
  void stop() noexcept override { stop_requested_ = true; }
  Result<void> release() override { return {}; }
  Result<void> correct(double turned_over_told) override;
  TurntableInfo info() const override { return info_; }

 private:
  HandTurntable(const TurntableOptions& options, AskPerson ask);
  std::int64_t ticksFor(double angle_rad) const;

  AskPerson ask_;
  TurntableInfo info_;
  std::int64_t ticks_ = 0;  // from where it stood at first
  std::int64_t origin_ticks_ = 0;
  std::atomic<bool> stop_requested_ = false;
};

}  // namespace gyre
