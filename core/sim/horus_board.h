// A board with the Horus firmware on it: a GRBL 0.9 that plans, counts degrees and has lasers.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// "ok" to G1 comes when the motion is planned; M70 and M71 wait for its end. Empty lines get no
// answer. Source: LibreScanner/horus-fw, report.c, gcode.c, laser_control.c.
class HorusBoard final : public LineBoard {
 public:
  using LineBoard::LineBoard;

  // Stops dead, and obeys nothing until it is reset.
  void pressLimitSwitch(double time_s) override;

 private:
  std::string greeting() const override { return "\r\nHorus 0.2 ['$' for help]"; }
  void restarted() override;
  void obey(std::string_view line) override;
  bool hearAtOnce(char c) override;
  void obeyMotion(std::string_view words);

  bool alarm_ = false;
  bool absolute_ = true;
  double position_deg_ = 0.0;
};

}  // namespace gyre
