// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/artivact_board.h"

#include <cstdlib>
#include <utility>

namespace gyre {
namespace {

TurntableFirmwareOptions withItsSteps(TurntableFirmwareOptions options) {
  options.steps_per_turn = static_cast<double>(ArtivactBoard::kSteps);
  return options;
}

}  // namespace

ArtivactBoard::ArtivactBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft)
    : LineBoard(withItsSteps(options), std::move(shaft)) {}

void ArtivactBoard::obey(std::string_view heard) {
  std::string line(heard);
  while (!line.empty() && line.back() == '\r') line.pop_back();
  if (line == "VERSION") {
    say("ARTIVACT_TT_V2");
  } else if (line.starts_with("MOVE")) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos) {
      say("ERR");
      return;
    }
    const int divisor = std::atoi(line.c_str() + space + 1);
    turnBy(divisor == 0 ? -1 : kSteps / divisor);  // what the processor makes of x / 0
    finishAtStandstill("OK");
  }
}

}  // namespace gyre
