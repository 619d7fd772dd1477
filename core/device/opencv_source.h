// Pictures from a camera of the system: streamed by OpenCV, set and asked by V4L2's own questions.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/device/frame_source.h"
#include "core/device/v4l2_modes.h"

namespace gyre {

// What is asked of the camera when it is opened.
struct OpenCvSourceOptions {
  int width_px = 0;           // with height: 0 for the largest size at least_frames_per_s
  int height_px = 0;          //
  double frames_per_s = 0.0;  // 0 for the fastest of the size
  std::string pixel_format;   // four letters, "MJPG"; empty for the fastest of the size
  int mains_hz = 0;           // 50 or 60, against flicker of lamps; 0 leaves the camera's own
  // A size at which the camera gives fewer pictures than this is not chosen by itself. [1/s], > 0
  double least_frames_per_s = 5.0;
};

// Reads "1920x1080", "1920x1080@MJPG" or "1920x1080@MJPG@30" into the options.
Result<OpenCvSourceOptions> cameraModeFromText(const std::string& mode);

// The mode of the list that the options ask for. kRejected, with the modes there are, when the
// camera has no such mode.
Result<VideoMode> chooseMode(std::span<const VideoMode> modes, const OpenCvSourceOptions& options);

// Whether a camera reads back what it was asked for; what was not asked (0, empty) is passed over.
// A slower rate is no other mode: cameras slow down in the dark.
bool keepsMode(const VideoMode& asked, const VideoMode& read_back);

// camera: "0" or "/dev/video0". kNotFound, kNoPermission, kBusy, kTimeout, or kRejected when the
// camera has no such mode.
Result<std::unique_ptr<FrameSource>> openOpenCvSource(const std::string& camera,
                                                      const OpenCvSourceOptions& options = {});

}  // namespace gyre
