// The board of Artivact's turntable, version 2.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/line_board.h"

namespace gyre {

// "MOVE n" turns by 12288 / n steps, without the remainder; "OK" comes after the motion. Other
// lines get no answer. Source: arassec/artivact, its turntable's sketch.
class ArtivactBoard final : public LineBoard {
 public:
  static constexpr std::int64_t kSteps = 12288;  // of one turn
  ArtivactBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft);

 private:
  void obey(std::string_view line) override;
  std::string_view lineEnds() const override { return "\n"; }
};

}  // namespace gyre
