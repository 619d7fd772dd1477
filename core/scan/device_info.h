// What is plugged in, and what it says of itself: facts for the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace gyre {

// A serial port, listed without opening it.
struct PortInfo {
  std::string path;         // what is opened: /dev/ttyACM0
  std::string stable_path;  // /dev/serial/by-id/..., empty when there is none
  std::string description;  // as the system names it
  std::string usb_id;       // "2341:0043", empty when not on USB
  bool may_open = false;    // the user has the permission
  std::string hindrance;    // what stands in the way, and the cure; empty when nothing does
};

// A camera, listed without opening it.
struct CameraDeviceInfo {
  std::string path;         // /dev/video0
  std::string description;  // as the driver names it
  bool may_open = false;
  std::string hindrance;
};

// What an identified turntable is.
struct TurntableInfo {
  std::string firmware;         // "Grbl 1.1h"
  std::string device_id;        // stable across reconnects where the port has a stable name
  std::string axis;             // letter of the firmware's axis that turns
  double units_per_turn = 0.0;  // what the firmware counts in one turn
  int direction = 1;            // +1 when the firmware's plus is counter-clockwise from above
  double steps_per_turn = 0.0;
  std::vector<std::string> hindrances;  // settings that hinder turning, in words
  // Why the board refuses to move until a person lets it be unlocked, and what to do about it;
  // empty when it does not.
  std::string lock = {};
};

// One camera control as asked for and as read back.
struct ControlState {
  std::string name;  // "focus", "exposure", "gain", "white balance"
  bool locked = false;
  double value = 0.0;
  std::string remark;     // why it could not be locked; empty when it could
  std::string word = {};  // the value as the camera names it, "1/125"; empty where it only counts
};

struct CameraInfo {
  std::string description;
  int width_px = 0;
  int height_px = 0;
  double frames_per_s = 0.0;
  std::vector<ControlState> controls;
  std::string mode = {};  // "1920x1080@MJPG"; empty when the camera has but one
  // All it can be opened in, as `mode` and with the rate, "1920x1080@MJPG@30"; empty when not told.
  std::vector<std::string> modes = {};
};

}  // namespace gyre
