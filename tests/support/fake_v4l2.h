// A video device that answers as the kernel's USB camera driver does, from a table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <linux/videodev2.h>

#include <cerrno>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/device/v4l2_device.h"

namespace gyre::test {

struct FakeControl {
  int value = 0;
  int step = 1;             // values are rounded to it
  bool stubborn = false;    // says yes and does not change
  bool wanders = false;     // grows by 1 each time it is asked
  bool read_only = false;   // refuses with EACCES
  std::uint32_t flags = 0;  // V4L2_CTRL_FLAG_...
};

struct FakeMode {
  std::uint32_t format = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> rates;  // whole pictures a second, fastest first
};

class FakeV4l2 final : public V4l2Device {
 public:
  std::map<std::uint32_t, FakeControl> controls;
  std::vector<FakeMode> modes;
  FakeMode present;
  bool stepwise = false;  // sizes are told as a range from 160 x 120 to the first mode's size
  bool gone = false;
  int busy_answers = 0;  // so many times EIO before each true answer

  // A webcam of the usual kind, all automatic.
  static FakeV4l2 webcam() {
    FakeV4l2 device;
    device.controls = {
        {V4L2_CID_FOCUS_AUTO, {1}},
        {V4L2_CID_FOCUS_ABSOLUTE, {35, 5}},
        {V4L2_CID_EXPOSURE_AUTO, {V4L2_EXPOSURE_APERTURE_PRIORITY}},
        {V4L2_CID_EXPOSURE_ABSOLUTE, {250}},
        {V4L2_CID_EXPOSURE_AUTO_PRIORITY, {1}},
        {V4L2_CID_GAIN, {64}},
        {V4L2_CID_AUTO_WHITE_BALANCE, {1}},
        {V4L2_CID_WHITE_BALANCE_TEMPERATURE, {4100}},
        {V4L2_CID_POWER_LINE_FREQUENCY, {V4L2_CID_POWER_LINE_FREQUENCY_60HZ}},
        {V4L2_CID_ZOOM_ABSOLUTE, {100}},
    };
    device.modes = {
        {V4L2_PIX_FMT_YUYV, 640, 480, {30, 15}},   {V4L2_PIX_FMT_YUYV, 1920, 1080, {5}},
        {V4L2_PIX_FMT_YUYV, 2304, 1536, {2}},      {V4L2_PIX_FMT_H264, 3840, 2160, {30}},
        {V4L2_PIX_FMT_MJPEG, 1280, 720, {60, 30}}, {V4L2_PIX_FMT_MJPEG, 1920, 1080, {30, 15, 5}}};
    device.present = device.modes.front();
    return device;
  }

  int ask(unsigned long request, void* structure) override {
    if (gone) return ENODEV;
    if (asked_++ % (busy_answers + 1) < busy_answers) return EIO;
    switch (request) {
      case VIDIOC_QUERYCTRL:
        return queryControl(*static_cast<v4l2_queryctrl*>(structure));
      case VIDIOC_G_CTRL:
        return getControl(*static_cast<v4l2_control*>(structure));
      case VIDIOC_S_CTRL:
        return setControl(*static_cast<v4l2_control*>(structure));
      case VIDIOC_ENUM_FMT:
        return tellFormat(*static_cast<v4l2_fmtdesc*>(structure));
      case VIDIOC_ENUM_FRAMESIZES:
        return tellSize(*static_cast<v4l2_frmsizeenum*>(structure));
      case VIDIOC_ENUM_FRAMEINTERVALS:
        return tellInterval(*static_cast<v4l2_frmivalenum*>(structure));
      case VIDIOC_G_FMT:
        return tellPresent(*static_cast<v4l2_format*>(structure));
      case VIDIOC_G_PARM:
        return tellRate(*static_cast<v4l2_streamparm*>(structure));
      default:
        return ENOTTY;
    }
  }

 private:
  int queryControl(v4l2_queryctrl& question) const {
    const auto found = controls.find(question.id);
    if (found == controls.end()) return EINVAL;
    question.flags = found->second.flags;
    question.step = found->second.step;
    return 0;
  }

  int getControl(v4l2_control& question) {
    const auto found = controls.find(question.id);
    if (found == controls.end()) return EINVAL;
    question.value = found->second.value;
    if (found->second.wanders) ++found->second.value;
    return 0;
  }

  int setControl(const v4l2_control& wish) {
    const auto found = controls.find(wish.id);
    if (found == controls.end()) return EINVAL;
    if (found->second.read_only) return EACCES;
    if (found->second.stubborn) return 0;
    found->second.value = wish.value / found->second.step * found->second.step;
    return 0;
  }

  int tellFormat(v4l2_fmtdesc& entry) const {
    std::vector<std::uint32_t> formats;
    for (const FakeMode& mode : modes) {
      if (formats.empty() || formats.back() != mode.format) formats.push_back(mode.format);
    }
    if (entry.index >= formats.size()) return EINVAL;
    entry.pixelformat = formats[entry.index];
    return 0;
  }

  int tellSize(v4l2_frmsizeenum& entry) const {
    std::uint32_t at = 0;
    for (const FakeMode& mode : modes) {
      if (mode.format != entry.pixel_format || at++ != entry.index) continue;
      if (stepwise) {
        entry.type = V4L2_FRMSIZE_TYPE_STEPWISE;
        entry.stepwise = {160, mode.width, 2, 120, mode.height, 2};
      } else {
        entry.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        entry.discrete = {mode.width, mode.height};
      }
      return 0;
    }
    return EINVAL;
  }

  int tellInterval(v4l2_frmivalenum& entry) const {
    for (const FakeMode& mode : modes) {
      if (mode.format != entry.pixel_format || mode.width != entry.width) continue;
      if (entry.index >= mode.rates.size()) return EINVAL;
      entry.type = V4L2_FRMIVAL_TYPE_DISCRETE;
      entry.discrete = {1, mode.rates[entry.index]};
      return 0;
    }
    return EINVAL;
  }

  int tellPresent(v4l2_format& answer) const {
    answer.fmt.pix.width = present.width;
    answer.fmt.pix.height = present.height;
    answer.fmt.pix.pixelformat = present.format;
    return 0;
  }

  int tellRate(v4l2_streamparm& answer) const {
    if (present.rates.empty()) return ENOTTY;
    answer.parm.capture.timeperframe = {1, present.rates.front()};
    return 0;
  }

  int asked_ = 0;
};

}  // namespace gyre::test
