// A table that somebody built: a few words over a motor, as resources/turntables/workshop.json
// describes them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// "Workshop table 1" at its start and to WHO; ON and OFF for the motor, answered by OK; "TURN n" by
// so many steps, answered by DONE at the end; STOP, answered by STOPPED; anything else by ERR.
class WorkshopBoard final : public LineBoard {
 public:
  using LineBoard::LineBoard;

 private:
  std::string greeting() const override { return "Workshop table 1"; }
  void restarted() override { switchMotorOff(); }
  void obey(std::string_view line) override;
  void remindOfBeingBusy() override { say("WAIT"); }
};

}  // namespace gyre
