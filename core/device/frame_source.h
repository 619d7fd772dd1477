// Where pictures come from: a driver, a stream, a simulator, as they come.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/scan/device_info.h"
#include "core/scan/frame.h"

namespace gyre {

// Like the drivers below it, a source queues pictures that nobody fetched: what grab() takes may
// be old. StreamingCamera is the cure. One thread uses a source.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // Takes the next picture from the driver without decoding it; waits for one at most timeout_s.
  // kTimeout when none came, kGone when the camera vanished for good. A time-out with advice says
  // what is wrong meanwhile, such as a network camera that is being looked for again.
  virtual Result<void> grab(double timeout_s) = 0;

  // True when grab(0) answers kTimeout, without waiting, exactly when no picture is queued. A
  // source whose driver cannot tell says false, and its grab() waits for a picture whatever the
  // time-out.
  virtual bool tellsEmptyQueue() const { return true; }

  // Decodes the picture taken last. Its view is -1, its time the moment of its grab().
  virtual Result<Frame> retrieve() = 0;

  // Locks focus, exposure, gain and white balance at their present values where the driver can,
  // reads them back, and tells which could not be locked.
  virtual CameraInfo lockControls() = 0;

  // The controls as the driver has them now; changes none.
  virtual CameraInfo readControls() { return info(); }
  virtual CameraInfo info() const = 0;

 protected:
  FrameSource() = default;
  FrameSource(const FrameSource&) = default;
  FrameSource& operator=(const FrameSource&) = default;
};

}  // namespace gyre
