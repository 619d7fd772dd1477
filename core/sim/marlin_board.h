// A printer's board with Marlin on it, whose X axis turns a table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// "ok" comes when a move is planned; M400 waits for its end, saying that it is busy. Numbered lines
// with a wrong number or sum are asked for again. Source: MarlinDocumentation, _gcode.
class MarlinBoard final : public LineBoard {
 public:
  enum class SoftEndstops { kOff, kOn };
  MarlinBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft,
              SoftEndstops endstops = SoftEndstops::kOff)
      : LineBoard(options, std::move(shaft)), endstops_(endstops) {}

  // Kills the board: it stops dead, and hears nothing until it is reset.
  void pressLimitSwitch(double time_s) override;

 private:
  std::string greeting() const override;
  void restarted() override;
  void obey(std::string_view line) override;
  void remindOfBeingBusy() override { say("echo:busy: processing"); }

  bool heardRight(std::string_view line, std::string& command);
  void obeyMotion(std::string_view words);
  bool obeyQuestion(std::string_view code);
  void setPosition(std::string_view words);

  SoftEndstops endstops_;
  bool killed_ = false;
  int last_line_ = 0;
  bool absolute_ = true;
  double position_ = 0.0;  // of X, in its unit
  double origin_ = 0.0;    // what G92 has shifted it by
};

}  // namespace gyre
