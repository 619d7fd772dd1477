// The G-code that the simulated firmware understands: lines into commands, by GRBL 1.1's rules.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace gyre {

// What stays in force from line to line. Positions are machine positions in the axis' own unit
// (degrees on a rotary axis; G20 scales words by 25.4 all the same, as the firmware does).
struct GcodeState {
  bool absolute = true;  // G90
  bool inches = false;   // G20
  int motion = 0;        // 0, 1 or 80
  double feed = 0.0;     // units per minute
  std::array<double, 3> position{};
  std::array<double, 3> offset{};  // of G92
};

// What one line asks for.
struct GcodeCommand {
  enum class Kind { kNothing, kMove, kDwell };
  Kind kind = Kind::kNothing;
  std::array<double, 3> target{};  // machine position
  double feed = 0.0;               // units per minute; 0 = as fast as the axis can
  double dwell_s = 0.0;
};

// Reads a line without spaces and comments, in capitals. Returns GRBL's error number, 0 for none;
// on an error the state is unchanged.
int readGcode(std::string_view line, GcodeState& state, GcodeCommand& command);

// The same for what follows "$J=": its own feed, and nothing but the position stays in force.
int readJog(std::string_view line, GcodeState& state, GcodeCommand& command);

}  // namespace gyre
