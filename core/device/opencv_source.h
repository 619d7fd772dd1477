// Pictures from a camera of the system (V4L2) or from a stream on the network, by OpenCV.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/device/frame_source.h"

namespace gyre {

// What is asked of the camera when it is opened.
struct OpenCvSourceOptions {
  int width_px = 0;             // with height: 0 leaves the camera's own mode; streams have but one
  int height_px = 0;            //
  double frames_per_s = 0.0;    // 0 leaves the camera's own
  std::string pixel_format;     // four letters, "MJPG"; empty leaves the camera's own
  double open_timeout_s = 5.0;  // streams only: drivers answer at once
  double read_timeout_s = 5.0;  // without a picture for so long, a stream is gone
};

// Reads "1920x1080", "1920x1080@MJPG" or "1920x1080@MJPG@30" into the options.
Result<OpenCvSourceOptions> cameraModeFromText(const std::string& mode);

// camera: "0", "/dev/video0", or a URL (http, https, rtsp; MJPEG or what FFmpeg reads).
// kNotFound, kNoPermission, kBusy, kTimeout, or kRejected when the camera has no such mode.
// No sentence of it, nor its info(), ever shows a password that stands in the URL.
Result<std::unique_ptr<FrameSource>> openOpenCvSource(const std::string& camera,
                                                      const OpenCvSourceOptions& options = {});

}  // namespace gyre
