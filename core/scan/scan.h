// A scan: what was asked for, and what has been captured so far.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scan/device_info.h"

namespace gyre {

// What NAME.gyre holds.
struct ScanSettings {
  std::string title;
  std::string inventory_number;
  std::string rights;
  std::string turntable;    // as on the command line: a port, tcp:HOST:PORT, sim[:OBJECT]
  std::string camera;       // as on the command line, without any password
  std::string camera_mode;  // as asked for: 1920x1080@MJPG; empty for the camera's own
  // How the camera was set when the scan began, as it read back; empty when nobody said.
  std::vector<ControlState> camera_controls;
  double units_per_turn = 360.0;  // what the firmware counts in one turn
  int direction = 1;              // +1 when its plus is counter-clockwise from above
  std::string axis = "X";         // letter of the firmware's axis that turns the table
  std::string sim_rig_json;       // the simulated rig's own settings; empty on real hardware
  int views = 200;                // over one full turn, evenly
  double start_angle_rad = 0.0;
};

// One captured view, as a line of journal.jsonl.
struct CapturedView {
  int view = 0;
  std::string file;              // below frames/
  double table_angle_rad = 0.0;  // as the integer steps give it
  std::int64_t steps = 0;        // motor steps from angle 0
  double sharpness = 0.0;
  std::string time_utc;  // ISO 8601
};

// Something that happened while a scan was taken, for the user, as a line of journal.jsonl.
struct ScanRemark {
  int view = 0;  // of which it was noticed
  std::string text;
  std::string time_utc;  // ISO 8601
};

}  // namespace gyre
