// The picture sizes, formats and rates that a video device offers.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/device/v4l2_device.h"

namespace gyre {

struct VideoMode {
  int width_px = 0;
  int height_px = 0;
  std::string pixel_format;   // four letters, "MJPG"
  double frames_per_s = 0.0;  // the fastest of this size and format; 0 when the driver does not say

  bool operator==(const VideoMode&) const = default;

  // "1920x1080@MJPG"
  std::string text() const;
};

// All modes in a format that can be decoded, in the driver's order; of a driver that offers any
// size between two, the two. Empty when it lists none.
std::vector<VideoMode> listModes(V4l2Device& device);

// The one with the most pixels among those of at least least_frames_per_s; of equals the faster,
// then the first. A rate that is not told counts as enough. When none is so fast, the fastest.
std::optional<VideoMode> bestMode(std::span<const VideoMode> modes, double least_frames_per_s);

// What the device is set to, as read back.
std::optional<VideoMode> currentMode(V4l2Device& device);

// "1920x1080@MJPG@30, 1280x720@MJPG@60": the largest of each format first, at most so many.
std::string modesText(std::span<const VideoMode> modes, std::size_t most);

}  // namespace gyre
