// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/comxim_board.h"

#include <charconv>
#include <cmath>
#include <utility>

namespace gyre {
namespace {

TurntableFirmwareOptions withItsSteps(TurntableFirmwareOptions options) {
  options.steps_per_turn = 14400.0;
  return options;
}

}  // namespace

ComXimBoard::ComXimBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft)
    : LineBoard(withItsSteps(options), std::move(shaft)) {}

void ComXimBoard::obey(std::string_view line) {
  constexpr std::string_view kTurn = "CT+TRUNSINGLE(";
  if (line.starts_with(kTurn) && line.size() > kTurn.size() + 2) {
    const bool counter_clockwise = line[kTurn.size()] == '1';
    double angle_deg = 0.0;
    const char* begin = line.data() + kTurn.size() + 2;
    const auto parsed = std::from_chars(begin, line.data() + line.size(), angle_deg);
    if (parsed.ec != std::errc() || angle_deg < 0.0) {
      say("CR+ERR");
      return;
    }
    turnByDeg(counter_clockwise ? angle_deg : -angle_deg);
  } else if (line == "CT+TOZERO()") {
    turnByDeg(static_cast<double>(zero_ - planned()) / stepsPerTurn() * 360.0);
  } else if (line == "CT+SETZERO()") {
    zero_ = planned();
    say("CR+OK");
  } else if (line.starts_with("CT+") || line == "CT()") {
    say("CR+OK");
  }
}

void ComXimBoard::turnByDeg(double by_deg) {
  say("CR+OK");
  const std::int64_t steps = std::llround(by_deg / 360.0 * stepsPerTurn());
  if (steps == 0) return;
  turnBy(steps);
  finishAtStandstill("CR+EVENT=TB_PAUSE;CR+EVENT=TB_END");
}

}  // namespace gyre
