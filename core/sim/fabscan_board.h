// A board with the FabScan firmware on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// Says nothing at its start, repeats what it hears, and says ">" after each line, moves included.
// Numbers are whole and have 16 bits; words stand apart. The motor is off until M17.
// Source: mariolukas/FabScanPi-Firmware, Interpreter.cpp, MotorDriver.cpp.
class FabScanBoard final : public LineBoard {
 public:
  using LineBoard::LineBoard;

 private:
  void restarted() override { switchMotorOff(); }
  void obey(std::string_view line) override;
  std::string_view lineEnds() const override { return "\n"; }
};

}  // namespace gyre
