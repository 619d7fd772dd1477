// A board with the Sardauscan firmware on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// Answers a move after the motion, with what it understood and where it stands.
// Source: Sardau/Sardauscan, FirmWare.ino.
class SardauscanBoard final : public LineBoard {
 public:
  using LineBoard::LineBoard;

 private:
  std::string greeting() const override { return "Sardauscan V0.1a"; }
  void restarted() override { zero_ = counted(); }
  void obey(std::string_view line) override;
  void obeyTable(const std::string& what, int number);
  std::int64_t position() const { return planned() - zero_; }

  std::int64_t zero_ = 0;
};

}  // namespace gyre
