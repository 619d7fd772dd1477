// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sardauscan_board.h"

#include <cstdint>
#include <cstdlib>
#include <sstream>

namespace gyre {

void SardauscanBoard::obey(std::string_view line) {
  std::istringstream words{std::string(line)};
  words.imbue(std::locale::classic());
  std::string first;
  std::string second;
  std::string third;
  words >> first >> second >> third;
  if (first == "sardauscan") {
    say("yes");
  } else if (first == "T") {
    obeyTable(second, static_cast<std::int16_t>(std::atoi(third.c_str())));
  } else if (first == "L") {
    say("LASER_COUNT: 4");
  } else {
    say("Hun?");
  }
}

void SardauscanBoard::obeyTable(const std::string& what, int number) {
  if (what.empty()) {
    say("Position " + std::to_string(position()));
  } else if (what == "S") {
    say("REVOLUTION STEPS  => " + std::to_string(static_cast<int>(stepsPerTurn())));
  } else if (what == "C") {
    zero_ = planned();
    say("RESET CUTTENT POSITION  => 0");
  } else if (what == "R") {
    turnBy(number);
    finishAtStandstill("RELATIVE ROTATION :" + std::to_string(number) + " => " +
                       std::to_string(position()));
  } else if (what == "A") {
    turnBy(number - position());
    finishAtStandstill("ABSOLUTE ROTATION " + std::to_string(number) + " => " +
                       std::to_string(position()));
  } else {
    say("Unknown Table command :" + what);
  }
}

}  // namespace gyre
