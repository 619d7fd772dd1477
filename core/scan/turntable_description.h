// How to speak to a turntable whose firmware Gyre does not know, as its owner describes it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace gyre {

// What is sent, and a part of the line that answers it. Nothing is sent when `send` is empty.
struct TurntableExchange {
  std::string send;
  std::string answer;
};

// Places in `move`: {by} becomes the way to turn, {to} the place to turn to, {speed} units a
// second. Read from a file by readTurntableDescription(), which says what a good one is.
struct TurntableDescription {
  enum class Unit { kSteps, kDegrees };

  std::string name;
  int baud = 115200;
  std::string line_end = "\n";       // after what is sent
  std::string answer_ends = "\r\n";  // each of these ends an answer
  std::string greeting;              // part of what it says when it starts; may be empty
  TurntableExchange ask;             // names it without moving it; may be empty with a greeting
  Unit unit = Unit::kSteps;
  double units_per_turn = 0.0;  // > 0
  int decimals = 0;             // of degrees
  int direction = 1;            // +1 when plus turns it counter-clockwise, seen from above
  TurntableExchange motor_on;   // may be empty
  TurntableExchange motor_off;  // may be empty
  std::string move;
  std::string done;        // part of the line that is said when the table stands
  std::string refused;     // part of the line that refuses; may be empty
  std::string busy;        // part of the line that asks for patience; may be empty
  TurntableExchange stop;  // may be empty
};

}  // namespace gyre
