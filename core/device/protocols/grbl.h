// The GRBL 1.1 wire protocol: bytes into messages, wishes into lines.
//
// Source: grbl/doc/markdown/interface.md and doc/csv. grblHAL and FluidNC speak it too.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyre {

enum class GrblState { kIdle, kRun, kHold, kJog, kAlarm, kDoor, kCheck, kHome, kSleep };

// "<Hold:1|MPos:1.000,0.000,0.000|FS:0,0>"
struct GrblStatus {
  GrblState state = GrblState::kAlarm;
  std::optional<int> substate;      // Hold:0 stands, Hold:1 still slows down
  std::vector<double> machine;      // MPos, an entry an axis; empty when not told
  std::vector<double> work;         // WPos
  std::vector<double> work_offset;  // WCO = MPos - WPos; told now and then
};

struct GrblMessage {
  enum class Kind {
    kOk,
    kError,     // number
    kAlarm,     // number
    kStatus,    // status
    kBanner,    // text: "Grbl 1.1h ['$' for help]": the board has (re)started
    kSetting,   // number, value: $100=8.889
    kFeedback,  // text: any other [...] or >...
    kGarbage,   // text: a line that is none of these
  };
  Kind kind = Kind::kGarbage;
  int number = 0;
  double value = 0.0;
  std::string text;
  GrblStatus status;
};

// A line without its end. Never fails: what is no message is garbage.
GrblMessage parseGrblLine(std::string_view line);

// Cuts a stream into messages. Resynchronises at the next line end after anything.
class GrblParser {
 public:
  void feed(std::span<const std::byte> bytes);
  std::optional<GrblMessage> next();  // nothing: more bytes are needed

 private:
  std::string line_;
  bool overlong_ = false;
  std::deque<GrblMessage> messages_;
};

// Realtime characters: heard at once, not answered, need no line end.
inline constexpr char kGrblStatusRequest = '?';
inline constexpr char kGrblHold = '!';
inline constexpr char kGrblSoftReset = 0x18;

// Moves the axis to a machine position, units and units per minute. Says everything it relies on
// in the same line, so that it may be sent twice: the second one does nothing.
std::string grblMove(char axis, double target, double feed);

// Answered when the motion before it has ended (commands.md, "G4 P0.01").
inline constexpr std::string_view kGrblBarrier = "G4P0.01";

// Index of an axis letter in a position: X 0, Y 1, Z 2, A 3, B 4, C 5.
std::size_t grblAxisIndex(char axis);

// What the numbers mean, as parts of a sentence.
std::string grblErrorText(int number);
std::string grblAlarmText(int number);

}  // namespace gyre
