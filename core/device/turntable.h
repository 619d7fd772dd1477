// A table that turns to an angle and says when it stands still there.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/device_info.h"

namespace gyre {

// Where a table stood, in its motor's own count.
struct TablePlace {
  int count = 0;  // of the motor steps: a new one begins whenever the angle was lost
  std::int64_t motor_steps = 0;
};

// Used by one thread at a time, but for stop(), which any thread may call at any time.
// Angles are the table's own: positive counter-clockwise seen from above.
class Turntable {
 public:
  virtual ~Turntable() = default;

  // Turns to the angle and returns when the table is known to stand still there. The angle is
  // rounded to whole motor steps, the remainder carried by computing each target from angle 0.
  // A stop request in the task or stop() slows the table down and returns kCancelled.
  virtual Result<void> moveTo(double angle_rad, const Task& task) = 0;

  // The angle, and the motor steps from angle 0, of the last confirmed standstill.
  virtual double angleRad() const = 0;
  virtual std::int64_t steps() const = 0;

  // The place of the last confirmed standstill. Neither setAngle() nor correct() changes places.
  virtual TablePlace place() const = 0;

  // The angle that a place of this table has as angles are counted now; nothing when the angle was
  // lost since the table stood there.
  virtual std::optional<double> angleAt(const TablePlace& place) const = 0;

  // Declares that the table now stands at this angle. Moves nothing.
  virtual Result<void> setAngle(double angle_rad) = 0;

  // Slows down and stops; returns at once. Motion that was asked for before never goes on.
  virtual void stop() noexcept = 0;

  // Lets go of the motor, so that it cools and can be turned by hand. The angle is then unknown:
  // moveTo() refuses until setAngle().
  virtual Result<void> release() = 0;

  // Tells how far the table was seen to turn for each radian it was told, negative for clockwise:
  // from then on one radian told is one turned, counter-clockwise. The angle at which it stands
  // becomes 0. Moves nothing; info() tells the corrected units. Fails when the ratio is absurd.
  virtual Result<void> correct(double turned_over_told) = 0;

  // How far a backward move at least passes its target and returns, so that play in gears or belt
  // is on the same side for every place [rad]. 0: not at all, to measure that play. Moves nothing;
  // a table that a hand turns has no such thing.
  virtual void setApproach(double approach_rad) { (void)approach_rad; }
  virtual double approachRad() const { return 0.0; }

  // A person's word that a board which info() calls locked may be unlocked by the next move. It
  // holds until the table is closed or its board stops by itself. Moves and sends nothing.
  virtual void allowUnlock() {}

  virtual TurntableInfo info() const = 0;

 protected:
  Turntable() = default;
  Turntable(const Turntable&) = default;
  Turntable& operator=(const Turntable&) = default;
};

}  // namespace gyre
