// A camera that gives pictures taken after a known moment.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/scan/device_info.h"
#include "core/scan/frame.h"

namespace gyre {

// Any thread may call any member.
class Camera {
 public:
  virtual ~Camera() = default;

  // The first picture whose exposure began after time_s (on the clock of steadySeconds()).
  // kTimeout when the camera gave none in time, kGone when it vanished, kCancelled on request.
  virtual Result<FramePtr> grabAfter(double time_s, const Task& task) = 0;

  // Locks and reads back the controls; see FrameSource.
  virtual Result<CameraInfo> lockControls() = 0;
  // The controls as they stand now, to see whether they stayed where they were locked.
  virtual Result<CameraInfo> readControls() { return info(); }
  virtual CameraInfo info() const = 0;

  // A picture for looking at, of any age and size. Other than grabAfter(), it costs no shutter of a
  // camera that has one. kRejected when the camera has no live picture.
  virtual Result<FramePtr> preview(const Task& task);

 protected:
  Camera() = default;
  Camera(const Camera&) = default;
  Camera& operator=(const Camera&) = default;
};

}  // namespace gyre
