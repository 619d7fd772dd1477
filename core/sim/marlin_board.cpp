// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/marlin_board.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace gyre {
namespace {

constexpr double kMost_units = 235.0;  // of the soft endstops, a printer's bed

std::optional<double> wordIn(std::string_view words, char letter) {
  const std::size_t at = words.find(std::string{' ', letter});
  if (at == std::string_view::npos) return std::nullopt;
  double value = 0.0;
  const auto parsed = std::from_chars(words.data() + at + 2, words.data() + words.size(), value);
  if (parsed.ec != std::errc()) return std::nullopt;
  return value;
}

int wholeAt(std::string_view text) {
  int value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::string MarlinBoard::greeting() const {
  return "start\r\necho:Marlin 2.1.2\r\necho: Last Updated: 2022-12-17\r\necho:SD card ok";
}

void MarlinBoard::pressLimitSwitch(double time_s) {
  advanceTo(time_s);
  stopDead();
  killed_ = true;
  say("Error:Printer halted. kill() called!");
}

void MarlinBoard::restarted() {
  killed_ = false;
  last_line_ = 0;
  absolute_ = true;
  position_ = origin_ = 0.0;
}

// "N3 M400*55": the number that is due, and the sum of what stands before the star.
bool MarlinBoard::heardRight(std::string_view line, std::string& command) {
  command = line;
  if (!line.starts_with('N')) return true;
  const std::size_t star = line.rfind('*');
  const int number = wholeAt(line.substr(1));
  unsigned sum = 0;
  for (const char c : line.substr(0, star)) sum ^= static_cast<unsigned char>(c);
  const bool right_sum =
      star != std::string_view::npos && wholeAt(line.substr(star + 1)) == static_cast<int>(sum);
  if (!right_sum || number != last_line_ + 1) {
    say(std::string(right_sum ? "Error:Line Number is not Last Line Number+1"
                              : "Error:checksum mismatch") +
        ", Last Line: " + std::to_string(last_line_));
    say("Resend: " + std::to_string(last_line_ + 1));
    say("ok");
    return false;
  }
  last_line_ = number;
  const std::size_t space = line.find(' ');
  command =
      space == std::string_view::npos ? "" : std::string(line.substr(space + 1, star - space - 1));
  return true;
}

void MarlinBoard::obey(std::string_view line) {
  std::string command;
  if (killed_) return;
  if (!heardRight(line, command)) return;
  const std::string code = command.substr(0, command.find(' '));
  if (code == "M400") {
    finishAtStandstill("ok");
    return;
  }
  if (code == "G0" || code == "G1") {
    obeyMotion(command);
  } else if (code == "G92") {
    setPosition(command);
  } else if (code == "G90" || code == "G91") {
    absolute_ = code == "G90";
  } else if (code == "M110") {
    last_line_ = static_cast<int>(wordIn(command, 'N').value_or(0.0));
  } else if (code == "M17") {
    switchMotorOn();
  } else if (code == "M18" || code == "M84") {
    switchMotorOff();
  } else if (code == "M410") {
    stopDead();
    position_ = static_cast<double>(counted()) / (stepsPerTurn() / 360.0);
  } else if (code != "G21" && !obeyQuestion(code)) {
    say("echo:Unknown command: \"" + command + "\"");
  }
  say("ok");
}

bool MarlinBoard::obeyQuestion(std::string_view code) {
  const double steps_per_unit = stepsPerTurn() / 360.0;
  if (code == "M115") {
    say("FIRMWARE_NAME:Marlin 2.1.2 (Dec 17 2022 12:00:00) "
        "SOURCE_CODE_URL:github.com/MarlinFirmware"
        " PROTOCOL_VERSION:1.0 MACHINE_TYPE:Turntable EXTRUDER_COUNT:0");
    say("Cap:EEPROM:1");
    say("Cap:AUTOREPORT_TEMP:0");
  } else if (code == "M114") {
    say("X:" + fixedText(position_ - origin_, 2) +
        " Y:0.00 Z:0.00 E:0.00 Count X:" + std::to_string(counted()) + " Y:0 Z:0");
  } else if (code == "M503") {
    say("echo:; Steps per unit:");
    say("echo: M92 X" + fixedText(steps_per_unit, 2) + " Y80.00 Z400.00 E93.00");
    say("echo:; Max feedrates (units/s):");
    say("echo: M203 X300.00 Y300.00 Z5.00 E25.00");
  } else if (code == "M211") {
    say(std::string("  M211 S") + (endstops_ == SoftEndstops::kOn ? "1 ; ON" : "0 ; OFF"));
    say("  Min:  X0.00 Y0.00 Z0.00   Max:  X235.00 Y235.00 Z250.00");
  } else {
    return false;
  }
  return true;
}

// G92 moves nothing: it says that here is X.
void MarlinBoard::setPosition(std::string_view words) {
  if (const auto x = wordIn(words, 'X')) origin_ = position_ - *x;
}

void MarlinBoard::obeyMotion(std::string_view words) {
  if (const auto feed = wordIn(words, 'F')) {
    setSpeed(std::max(0.1, *feed / 60.0) * stepsPerTurn() / 360.0);
  }
  const auto x = wordIn(words, 'X');
  if (!x) return;
  double target = absolute_ ? *x + origin_ : position_ + *x;
  if (endstops_ == SoftEndstops::kOn) target = std::clamp(target, 0.0, kMost_units);
  const auto to = std::llround(target * stepsPerTurn() / 360.0);
  position_ = target;
  turnBy(to - planned());
}

}  // namespace gyre
