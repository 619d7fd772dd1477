// Turns the table view by view and captures each one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"
#include "core/io/scan_store.h"

namespace gyre {

// Captures every view that the store does not hold yet: the table is turned to the view's angle, a
// picture exposed after standstill is taken, written and synced; only then the table moves on.
// on_view is called in this thread after each view is safe on the disk, and may block: the table
// waits. Returns when the turn is complete. On any failure, and on a stop request (kCancelled), the
// table is stopped and what was captured stays in the store. The table angle of the first missing
// view's predecessor must be known to the turntable (Turntable::setAngle) when a scan is resumed.
Result<void> acquire(Turntable& turntable, Camera& camera, ScanStore& store,
                     const std::function<void(const FramePtr&)>& on_view, const Task& task);

}  // namespace gyre
