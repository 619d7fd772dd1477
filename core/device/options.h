// What a user may change about devices.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/option_list.h"
#include "core/base/result.h"

namespace gyre {

struct TurntableOptions {
  std::string axis = "X";         // the letter of the axis that turns the table: X Y Z A B C
  double units_per_turn = 360.0;  // what the firmware counts in one turn: 360 for degrees
  int direction = 1;              // +1 when the firmware's plus is counter-clockwise from above
  double speed_deg_per_s = 20.0;  // objects that can topple or slip want less
  double approach_deg = 2.0;      // how far a backward move goes past its target and returns
  double steps_per_turn = 0.0;    // as measured; 0 = as the firmware's settings say
  bool turning_measured = false;  // a camera found units and direction: they need not be round
  double greeting_s = 3.0;        // how long a board may take to start after its port is opened
  std::string device_id;          // stable name for reports; empty = the port's name
  bool may_unlock = false;        // a person has said that a locked board may be unlocked

  template <class V>
  void describe(V& visit) {
    visit({"axis", "", 0, 0, "Letter of the firmware's axis that turns the table."}, axis);
    visit({"units-per-turn", "", 0.001, 1e6,
           "What the firmware counts in one turn: 360 when its unit is a degree."},
          units_per_turn);
    visit({"direction", "", -1, 1, "1, or -1 when the table turns the other way round."},
          direction);
    visit({"speed", "deg/s", 0.1, 360, "How fast the table turns; slower for what may slip."},
          speed_deg_per_s);
    visit({"approach", "deg", 0, 45,
           "How far a backward move passes its target, to come from the same side always."},
          approach_deg);
    visit({"steps-per-turn", "", 0, 1e8, "Motor steps of one turn; 0 takes the firmware's word."},
          steps_per_turn);
    visit({"greeting", "s", 0.1, 30, "How long a board may take to start; longer for slow ones."},
          greeting_s);
  }

  Result<void> validate() const {
    if (axis.size() != 1 || std::string("XYZABC").find(axis) == std::string::npos) {
      return Error{Error::Code::kInvalidInput, "The turntable's axis is called \"" + axis + "\".",
                   "Use one of the letters X, Y, Z, A, B, C."};
    }
    if (direction == 0) {
      return Error{Error::Code::kInvalidInput, "The turntable's direction is 0.", "Use 1 or -1."};
    }
    return validateRanges(*this);
  }
};

}  // namespace gyre
