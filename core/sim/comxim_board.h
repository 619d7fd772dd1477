// The controller of a ComXim table.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// Commands and answers end with ";", without a line end. A move is answered at once, and once more
// at its end, a move that has nothing to do only at once. Forty motor steps are a degree. Source:
// ComXim's manual.
class ComXimBoard final : public LineBoard {
 public:
  ComXimBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft);

 private:
  void obey(std::string_view line) override;
  std::string_view lineEnds() const override { return ";"; }
  std::string_view answerEnd() const override { return ";"; }
  bool hearAtOnce(char c) override { return c == '\r' || c == '\n'; }
  void turnByDeg(double by_deg);

  std::int64_t zero_ = 0;
};

}  // namespace gyre
