// The questions that a video device of the system answers, asked through ioctl.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"

namespace gyre {

// One open video device. Streams and questions may come over different openings of the same
// device: the kernel allows it, and OpenCV keeps its own to itself. Tests put recorded answers in
// its place. One thread.
class V4l2Device {
 public:
  virtual ~V4l2Device() = default;

  // ioctl(2) with a request of <linux/videodev2.h> and its structure. Gives 0 or the error number.
  virtual int ask(unsigned long request, void* structure) = 0;

 protected:
  V4l2Device() = default;
  V4l2Device(const V4l2Device&) = default;
  V4l2Device& operator=(const V4l2Device&) = default;
};

// Opens "/dev/video0" for questions. kNotFound, kNoPermission, kIo.
Result<std::unique_ptr<V4l2Device>> openV4l2Device(const std::string& path);

}  // namespace gyre
