// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/workshop_board.h"

#include <charconv>

namespace gyre {

void WorkshopBoard::obey(std::string_view line) {
  constexpr std::string_view kTurn = "TURN ";
  if (line == "WHO") {
    say(greeting());
  } else if (line == "ON" || line == "OFF") {
    if (line == "ON") switchMotorOn();
    if (line == "OFF") switchMotorOff();
    say("OK");
  } else if (line == "STOP") {
    stopDead();
    say("STOPPED");
  } else if (line.starts_with(kTurn)) {
    int steps = 0;
    const char* end = line.data() + line.size();
    const auto parsed = std::from_chars(line.data() + kTurn.size(), end, steps);
    if (parsed.ec != std::errc() || parsed.ptr != end) {
      say("ERR");
      return;
    }
    turnBy(steps);
    finishAtStandstill("DONE");
  } else {
    say("ERR");
  }
}

}  // namespace gyre
