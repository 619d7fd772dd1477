// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/v4l2_modes.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace gyre {
namespace {

// A driver that goes on answering for ever is cut off here.
constexpr std::uint32_t kMostEntries = 256;

// What OpenCV turns into a colour picture. H.264 and its kin are not among them.
constexpr std::array kDecodable = {
    V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_JPEG,  V4L2_PIX_FMT_YUYV,   V4L2_PIX_FMT_UYVY,
    V4L2_PIX_FMT_NV12,  V4L2_PIX_FMT_NV21,  V4L2_PIX_FMT_YUV420, V4L2_PIX_FMT_YVU420,
    V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_BGR24, V4L2_PIX_FMT_GREY,
};

std::string lettersOf(std::uint32_t format) {
  std::string letters;
  for (int i = 0; i < 4; ++i) letters.push_back(static_cast<char>((format >> (8 * i)) & 0x7FU));
  return letters;
}

double rateOf(const v4l2_fract& interval) {
  if (interval.numerator == 0 || interval.denominator == 0) return 0.0;
  return static_cast<double>(interval.denominator) / interval.numerator;
}

double fastestRate(V4l2Device& device, std::uint32_t format, std::uint32_t width,
                   std::uint32_t height) {
  double fastest = 0.0;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmivalenum entry{};
    entry.index = i;
    entry.pixel_format = format;
    entry.width = width;
    entry.height = height;
    if (device.ask(VIDIOC_ENUM_FRAMEINTERVALS, &entry) != 0) break;
    const bool discrete = entry.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    fastest = std::max(fastest, rateOf(discrete ? entry.discrete : entry.stepwise.min));
    if (!discrete) break;  // one entry describes all
  }
  return fastest;
}

void addSizes(V4l2Device& device, std::uint32_t format, std::vector<VideoMode>& modes) {
  const auto add = [&](std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) return;
    modes.push_back({static_cast<int>(width), static_cast<int>(height), lettersOf(format),
                     fastestRate(device, format, width, height)});
  };
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmsizeenum entry{};
    entry.index = i;
    entry.pixel_format = format;
    if (device.ask(VIDIOC_ENUM_FRAMESIZES, &entry) != 0) return;
    if (entry.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      add(entry.discrete.width, entry.discrete.height);
      continue;
    }
    add(entry.stepwise.max_width, entry.stepwise.max_height);
    add(entry.stepwise.min_width, entry.stepwise.min_height);
    return;
  }
}

std::int64_t pixelsOf(const VideoMode& mode) {
  return std::int64_t{mode.width_px} * mode.height_px;
}

}  // namespace

std::string VideoMode::text() const {
  return std::to_string(width_px) + "x" + std::to_string(height_px) +
         (pixel_format.empty() ? "" : "@" + pixel_format);
}

std::vector<VideoMode> listModes(V4l2Device& device) {
  std::vector<VideoMode> modes;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (device.ask(VIDIOC_ENUM_FMT, &entry) != 0) break;
    if (std::find(kDecodable.begin(), kDecodable.end(), entry.pixelformat) == kDecodable.end()) {
      continue;
    }
    addSizes(device, entry.pixelformat, modes);
  }
  return modes;
}

std::optional<VideoMode> bestMode(std::span<const VideoMode> modes, double least_frames_per_s) {
  const auto fast_enough = [&](const VideoMode& mode) {
    return mode.frames_per_s <= 0.0 || mode.frames_per_s >= least_frames_per_s;
  };
  const VideoMode* best = nullptr;
  for (const VideoMode& mode : modes) {
    if (!fast_enough(mode)) continue;
    const bool better =
        best == nullptr || pixelsOf(mode) > pixelsOf(*best) ||
        (pixelsOf(mode) == pixelsOf(*best) && mode.frames_per_s > best->frames_per_s);
    if (better) best = &mode;
  }
  if (best != nullptr) return *best;
  const auto fastest = std::max_element(
      modes.begin(), modes.end(),
      [](const VideoMode& a, const VideoMode& b) { return a.frames_per_s < b.frames_per_s; });
  return fastest == modes.end() ? std::nullopt : std::optional(*fastest);
}

std::optional<VideoMode> currentMode(V4l2Device& device) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (device.ask(VIDIOC_G_FMT, &format) != 0) return std::nullopt;
  VideoMode mode;
  mode.width_px = static_cast<int>(format.fmt.pix.width);
  mode.height_px = static_cast<int>(format.fmt.pix.height);
  mode.pixel_format = lettersOf(format.fmt.pix.pixelformat);
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (device.ask(VIDIOC_G_PARM, &rate) == 0) {
    mode.frames_per_s = rateOf(rate.parm.capture.timeperframe);
  }
  return mode;
}

std::string modesText(std::span<const VideoMode> modes, std::size_t most) {
  std::vector<VideoMode> sorted(modes.begin(), modes.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const VideoMode& a, const VideoMode& b) {
    return pixelsOf(a) > pixelsOf(b);
  });
  std::string text;
  for (std::size_t i = 0; i < sorted.size() && i < most; ++i) {
    const long rate = std::lround(sorted[i].frames_per_s);
    text += (i == 0 ? "" : ", ") + sorted[i].text() + (rate > 0 ? "@" + std::to_string(rate) : "");
  }
  return text;
}

}  // namespace gyre
