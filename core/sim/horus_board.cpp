// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/horus_board.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace gyre {
namespace {

// The number after the letter, in "G1X30.5".
std::optional<double> wordIn(std::string_view words, char letter, std::size_t from) {
  const std::size_t at = words.find(letter, from);
  if (at == std::string_view::npos) return std::nullopt;
  double value = 0.0;
  const char* end = words.data() + words.size();
  const auto parsed = std::from_chars(words.data() + at + 1, end, value);
  if (parsed.ec != std::errc()) return std::nullopt;
  return value;
}

}  // namespace

void HorusBoard::pressLimitSwitch(double time_s) {
  advanceTo(time_s);
  stopDead();
  alarm_ = true;
  say("ALARM: Hard limit");
}

void HorusBoard::restarted() {
  alarm_ = false;
  absolute_ = true;
  position_deg_ = 0.0;
}

bool HorusBoard::hearAtOnce(char c) {
  constexpr char kSoftReset = 0x18;
  if (c == kSoftReset) {
    stopDead();
    restart();
    return true;
  }
  if (c == '?') {
    say(std::string(moving() ? "<Run" : "<Idle") + ",MPos:0.000,0.000,0.000>");
    return true;
  }
  return c == '!' || c == '~';
}

void HorusBoard::obey(std::string_view line) {
  if (alarm_) {
    say("error: Alarm lock");
    return;
  }
  std::string words;
  for (const char c : line) {
    if (c != ' ') words += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  }
  if (words.starts_with("G1")) {
    obeyMotion(words);
  } else if (words.starts_with("M70T") || words.starts_with("M71T")) {
    finishAtStandstill("ok");
  } else if (words == "$$") {
    say("$100=" + fixedText(stepsPerTurn() / 360.0, 3) + " (x, step/deg)");
    say("$120=200.000 (x accel, deg/sec^2)");
    say("ok");
  } else if (words == "G50" || words == "G90" || words == "G91" || words == "M17" ||
             words == "M18") {
    if (words == "G50") position_deg_ = 0.0;
    if (words == "G90" || words == "G91") absolute_ = words == "G90";
    if (words == "M17") switchMotorOn();
    if (words == "M18") switchMotorOff();
    say("ok");
  } else {
    say("error: Unsupported command");
  }
}

void HorusBoard::obeyMotion(std::string_view words) {
  const auto feed = wordIn(words, 'F', 2);
  const auto to = wordIn(words, 'X', 2);
  if (!feed && !to) {
    say("error: Bad number format");
    return;
  }
  if (feed) setSpeed(std::max(0.1, *feed) / 360.0 * stepsPerTurn());
  if (to) {
    const double per_degree = stepsPerTurn() / 360.0;
    const double target = absolute_ ? *to : position_deg_ + *to;
    const auto by = std::llround(target * per_degree) - std::llround(position_deg_ * per_degree);
    position_deg_ = target;
    if (!turnBy(by)) {
      say("error: Planner full");
      return;
    }
  }
  say("ok");
}

}  // namespace gyre
