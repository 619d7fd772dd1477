// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/v4l2_controls.h"

#include <linux/videodev2.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>

namespace gyre {
namespace {

constexpr const char* kNotOffered =
    "The camera does not offer it to programs; set it on the camera itself.";
constexpr const char* kKeepsChanging = "The camera keeps changing it by itself.";
// USB cameras answer with an error now and then while they stream; the next question is answered.
constexpr int kTries = 3;

// A control, and the one by which the camera changes it by itself.
struct Control {
  const char* name;
  std::uint32_t value;
  std::uint32_t automatic;  // 0: there is none
  int manual;               // the value of `automatic` that leaves the control alone
};

constexpr std::array kControls = {
    Control{"focus", V4L2_CID_FOCUS_ABSOLUTE, V4L2_CID_FOCUS_AUTO, 0},
    Control{"exposure", V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL},
    Control{"gain", V4L2_CID_GAIN, V4L2_CID_AUTOGAIN, 0},
    Control{"white balance", V4L2_CID_WHITE_BALANCE_TEMPERATURE, V4L2_CID_AUTO_WHITE_BALANCE, 0},
    Control{"zoom", V4L2_CID_ZOOM_ABSOLUTE, 0, 0},
};

int askPatiently(V4l2Device& device, unsigned long request, void* structure) {
  int problem = EIO;
  for (int i = 0; i < kTries && problem == EIO; ++i) problem = device.ask(request, structure);
  return problem;
}

bool offers(V4l2Device& device, std::uint32_t id) {
  v4l2_queryctrl question{};
  question.id = id;
  return askPatiently(device, VIDIOC_QUERYCTRL, &question) == 0 &&
         (question.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

std::optional<int> valueOf(V4l2Device& device, std::uint32_t id) {
  v4l2_control control{};
  control.id = id;
  if (askPatiently(device, VIDIOC_G_CTRL, &control) != 0) return std::nullopt;
  return control.value;
}

// The value that the control has afterwards.
std::optional<int> set(V4l2Device& device, std::uint32_t id, int value) {
  v4l2_control control{};
  control.id = id;
  control.value = value;
  static_cast<void>(askPatiently(device, VIDIOC_S_CTRL, &control));
  return valueOf(device, id);
}

bool isManual(V4l2Device& device, const Control& control) {
  if (control.automatic == 0 || !offers(device, control.automatic)) return true;
  return valueOf(device, control.automatic) == control.manual;
}

ControlState stateOf(V4l2Device& device, const Control& control) {
  ControlState state{control.name, false, 0.0, kNotOffered};
  if (!offers(device, control.value)) return state;
  const auto value = valueOf(device, control.value);
  if (!value) return state;
  state.value = *value;
  state.locked = isManual(device, control);
  state.remark = state.locked ? "" : kKeepsChanging;
  return state;
}

ControlState lock(V4l2Device& device, const Control& control) {
  if (!offers(device, control.value)) return stateOf(device, control);
  // The value first: with the automatic ended, some cameras jump to one of long ago.
  const auto present = valueOf(device, control.value);
  if (control.automatic != 0 && offers(device, control.automatic)) {
    static_cast<void>(set(device, control.automatic, control.manual));
  }
  if (present) static_cast<void>(set(device, control.value, *present));
  ControlState state = stateOf(device, control);
  if (state.locked && present && state.value != *present) {
    state.locked = false;
    state.remark = kKeepsChanging;
  }
  return state;
}

ControlState mainsState(V4l2Device& device) {
  ControlState state{"mains frequency", false, 0.0, kNotOffered};
  const auto choice = offers(device, V4L2_CID_POWER_LINE_FREQUENCY)
                          ? valueOf(device, V4L2_CID_POWER_LINE_FREQUENCY)
                          : std::nullopt;
  if (!choice) return state;
  if (*choice == V4L2_CID_POWER_LINE_FREQUENCY_50HZ) state.value = 50.0;
  if (*choice == V4L2_CID_POWER_LINE_FREQUENCY_60HZ) state.value = 60.0;
  state.locked = state.value > 0.0;
  state.remark = state.locked ? ""
                              : "Lamps may flicker from picture to picture; give --mains-hz 50 or "
                                "60, as your mains have it.";
  return state;
}

bool isTold(const ControlState& state) {
  const bool optional = state.name == "zoom" || state.name == "mains frequency";
  return !optional || state.remark != kNotOffered;
}

}  // namespace

std::vector<ControlState> lockV4l2Controls(V4l2Device& device, const V4l2LockOptions& options) {
  if (options.mains_hz == 50 || options.mains_hz == 60) {
    static_cast<void>(set(device, V4L2_CID_POWER_LINE_FREQUENCY,
                          options.mains_hz == 50 ? V4L2_CID_POWER_LINE_FREQUENCY_50HZ
                                                 : V4L2_CID_POWER_LINE_FREQUENCY_60HZ));
  }
  // Else a camera in the dark exposes longer than its rate has room for, and the rate sinks.
  if (offers(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY)) {
    static_cast<void>(set(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0));
  }
  for (const Control& control : kControls) static_cast<void>(lock(device, control));
  // Read when all are set: ending one automatic starts another in some cameras.
  std::vector<ControlState> locked;
  locked.reserve(kControls.size() + 1);
  for (const Control& control : kControls) locked.push_back(lock(device, control));
  locked.push_back(mainsState(device));
  std::erase_if(locked, [](const ControlState& state) { return !isTold(state); });
  return locked;
}

std::vector<ControlState> readV4l2Controls(V4l2Device& device) {
  std::vector<ControlState> states;
  states.reserve(kControls.size() + 1);
  for (const Control& control : kControls) states.push_back(stateOf(device, control));
  states.push_back(mainsState(device));
  std::erase_if(states, [](const ControlState& state) { return !isTold(state); });
  return states;
}

}  // namespace gyre
