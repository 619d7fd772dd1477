// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/free_hand.h"

#include <memory>
#include <optional>
#include <utility>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/pipeline/platter_ring.h"
#include "core/pipeline/settling.h"

namespace gyre {
namespace {

// Between two pictures that must agree: a hand that turns slowly is seen by then.
constexpr double kStill_s = 0.3;
// Of the way between two views. Less than half, or one place would do for two views.
constexpr double kNearEnough = 0.35;

// The first picture from now on that shows what one shortly before it showed, too.
Result<FramePtr> pictureAtRest(Camera& camera, const Task& task) {
  auto before = camera.grabAfter(steadySeconds(), task);
  while (before) {
    auto after = camera.grabAfter((*before)->time_s + kStill_s, task);
    if (!after || (*after)->image_bgr.size() != (*before)->image_bgr.size()) return after;
    if (!somethingMoved((*before)->image_bgr, (*after)->image_bgr)) return after;
    before = std::move(after);
  }
  return before;
}

}  // namespace

bool namesFreeHand(const std::string& turntable_word) { return turntable_word == "hand:free"; }

Result<void> watchByRing(Rig& rig, const CalibrationRecord& record, int views, TellPerson tell,
                         const Task& task) {
  const auto ring = PlatterRing::of(record);
  if (!ring) {
    return Error{Error::Code::kInvalidInput,
                 "A table that is turned freely needs a ring of markers on its platter, and the "
                 "calibration knows of none.",
                 "Print and calibrate with a ring, or turn by marks: --turntable hand:36."};
  }
  auto see = [camera = rig.camera.get(),
              ring](const Task& looking) -> Result<std::optional<double>> {
    const auto picture = pictureAtRest(*camera, looking);
    if (!picture) return picture.error();
    return ring->angleIn((*picture)->image_bgr);
  };
  auto table = WatchedTurntable::open(std::move(see), std::move(tell),
                                      kNearEnough * kTurn_rad / views, task);
  if (!table) return table.error();
  rig.turntable = std::move(table).value();
  return {};
}

}  // namespace gyre
