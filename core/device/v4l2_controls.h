// Focus, exposure, gain and white balance of a video device: held still and read back.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/device/v4l2_device.h"
#include "core/scan/device_info.h"

namespace gyre {

struct V4l2LockOptions {
  // The mains' frequency, against which lamps flicker. [Hz], 50 or 60; 0 leaves the camera's own.
  int mains_hz = 0;
};

// Ends the automatic behind each control, sets the control to its present value and reads both
// back: locked is only what the driver then still says. What it does not offer, or keeps changing,
// carries the reason. "zoom" is told where there is one. Values are the driver's own counts, the
// mains' frequency in Hz.
std::vector<ControlState> lockV4l2Controls(V4l2Device& device, const V4l2LockOptions& options = {});

// The same controls as they stand now; changes none.
std::vector<ControlState> readV4l2Controls(V4l2Device& device);

}  // namespace gyre
