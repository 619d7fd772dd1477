// What is the matter with a serial port, or with what is behind it: facts for the user.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gyre {

// What was heard at one speed of the port after one question; nothing after most of them.
struct TableAnswer {
  int baud = 0;          // 0 where the port has no speed
  std::string asked;     // printable; "(nothing)" for what came by itself
  std::string heard;     // printable, anything else as dots
  bool legible = false;  // most of it is text: the speed is right
};

enum class PortState : std::uint8_t {
  kReady,            // may be opened; it was not asked who is there
  kTurntable,        // a known firmware answers, and nothing hinders it
  kHindered,         // a known firmware answers, but its settings hinder turning
  kLocked,           // a known firmware answers, and moves nothing until it is unlocked
  kNoDevice,         // there is nothing of this name
  kNoDriver,         // a USB adapter is plugged in and has no port
  kGrabbed,          // the same, because brltty takes it for a braille display
  kNoPermission,     // this user may not open it
  kBusy,             // another program holds it
  kMoving,           // a machine that is at work
  kGarbled,          // something speaks, at another speed
  kUnknownFirmware,  // something speaks, legibly, that is not known
  kSilent,           // nothing answers: no power, no firmware, or another port
  kMotorStands,      // it obeys, and the camera sees no motion
  kGone,             // it vanished while it was asked
  kFailed,           // anything else
};

struct PortDiagnosis {
  std::string port;  // "/dev/ttyUSB0", or the adapter's USB id where there is no port
  PortState state = PortState::kReady;
  std::string what;     // a sentence
  std::string advice;   // what to do, with whole commands; may be empty
  std::string held_by;  // "cura (4711)": who holds a busy port, where that can be seen
  std::string firmware;
  int baud = 0;
  double steps_per_turn = 0.0;
  std::vector<std::string> hindrances;  // a sentence each, with its cure
  std::vector<TableAnswer> answers;     // all that was asked, and what was heard
};

}  // namespace gyre
