// A table without a motor that a person turns freely, while a camera tells where it stands.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/turntable.h"

namespace gyre {

// Waits until nothing moves and tells where the table stands [rad], in any count of whole turns;
// nothing when that cannot be seen.
using SeeTable = std::function<Result<std::optional<double>>(const Task& task)>;

// What the person is told while the table is not yet where it shall be.
struct FreeTurn {
  bool seen = true;     // false: where it stands cannot be seen, and the rest means nothing
  double by_deg = 0.0;  // still to go; positive counter-clockwise, seen from above
  double to_deg = 0.0;  // where it shall stand, in [0, 360)
};
using TellPerson = std::function<void(const FreeTurn& turn)>;

// Its angle is the one that is seen, so a person need not turn it exactly: near enough will do. It
// is to be turned by less than half a turn between two looks. steps() are hundredths of a degree.
class WatchedTurntable final : public Turntable {
 public:
  // near_enough_rad: how far a place may be off where the table was asked to go. > 0
  // The table stands at the angle 0. kNotFound when it cannot be seen where that is.
  static Result<std::unique_ptr<WatchedTurntable>> open(SeeTable see, TellPerson tell,
                                                        double near_enough_rad, const Task& task);

  // Returns when the table is seen to stand near the angle; waits for the person as long as it
  // takes. angleRad() tells where it truly stands.
  Result<void> moveTo(double angle_rad, const Task& task) override;
  double angleRad() const override { return stands_rad_ - zero_rad_; }
  std::int64_t steps() const override;
  TablePlace place() const override;
  std::optional<double> angleAt(const TablePlace& place) const override;
  Result<void> setAngle(double angle_rad) override;
  void stop() noexcept override { stop_requested_ = true; }
  Result<void> release() override { return {}; }
  // There is nothing to correct: a radian seen is a radian turned.
  Result<void> correct(double turned_over_told) override;
  TurntableInfo info() const override;

 private:
  WatchedTurntable(SeeTable see, TellPerson tell, double near_enough_rad)
      : see_(std::move(see)), tell_(std::move(tell)), near_enough_rad_(near_enough_rad) {}
  Result<bool> look(const Task& task);

  SeeTable see_;
  TellPerson tell_;
  const double near_enough_rad_;
  double stands_rad_ = 0.0;  // as seen, whole turns counted
  double zero_rad_ = 0.0;
  std::atomic<bool> stop_requested_ = false;
};

}  // namespace gyre
