// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/grbl_board.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gyre {
namespace {

constexpr std::size_t kReceiveBuffer_bytes = 128;
constexpr std::size_t kLongestLine = 80;
// A motor that is stopped dead runs on for about this long: why the firmware calls it lost.
constexpr double kSlip_s = 0.01;
constexpr double kAlarmPause_s = 0.5;  // in which the message of an alarm leaves the board
constexpr double kHeldOn_ms = 255.0;   // $1: the motor stays on when idle

constexpr int kSettingDisabled = 5;
constexpr int kNotIdle = 8;
constexpr int kLocked = 9;
constexpr int kLineTooLong = 11;
constexpr int kTravelExceeded = 15;

}  // namespace

GrblBoard::GrblBoard(const TurntableFirmwareOptions& options, std::shared_ptr<Shaft> shaft)
    : options_(options), shaft_(std::move(shaft)), settings_(options) {
  shaft_at_zero_ = shaft_->steps();
}

void GrblBoard::reset(double time_s) {
  advanceTo(time_s);
  stopDead();
  shaft_at_zero_ = shaft_->steps();
  motion_.setSteps(0);
  alarm_ = asleep_ = needs_reset_ = false;
  received_.clear();
  pending_.reset();
  boots_at_s_ = time_s + options_.boot_time_s;
}

void GrblBoard::boot() {
  boots_at_s_.reset();
  received_.clear();
  pending_.reset();
  jogging_ = cancelling_jog_ = needs_reset_ = false;
  reports_ = 0;
  gcode_ = {};
  readPositionBack();
  if (std::exchange(asleep_, false) || setting(GrblSettings::kHoming) != 0.0) alarm_ = true;
  say("");
  say("Grbl 1.1h ['$' for help]");
  if (alarm_) say("[MSG:'$H'|'$X' to unlock]");
}

// The banner comes once the motor has been let go of, which $1 delays, asleep even at 255.
void GrblBoard::softReset(double time_s) {
  double pause_s = 0.0;
  if (motion_.moving()) {
    alarm_ = true;
    pause_s = kAlarmPause_s;
    say("ALARM:3");
  }
  const double idle_ms = setting(GrblSettings::kIdleDelay);
  if (pause_s > 0.0 || asleep_ || idle_ms != kHeldOn_ms) pause_s += 0.001 * idle_ms;
  stopDead();
  if (pause_s > 0.0) {
    boots_at_s_ = time_s + pause_s;
  } else {
    boot();
  }
}

// The motor cannot stop at once: the shaft runs on, uncounted.
void GrblBoard::stopDead() {
  const auto slip = static_cast<std::int64_t>(std::lround(motion_.speed() * kSlip_s));
  shaft_at_zero_ += sign() * motion_.direction() * slip;
  motion_.stopDead();
  turnShaft();
}

void GrblBoard::turnShaft() { shaft_->setSteps(shaft_at_zero_ + sign() * motion_.steps()); }

double GrblBoard::unitsOf(std::int64_t steps) const {
  return static_cast<double>(steps) / setting(GrblSettings::kStepsPerUnit);
}

void GrblBoard::readPositionBack() { gcode_.position[0] = unitsOf(motion_.steps()); }

void GrblBoard::raiseAlarm(int number) {
  stopDead();
  alarm_ = needs_reset_ = true;
  say("ALARM:" + std::to_string(number));
  say("[MSG:Reset to continue]");
}

void GrblBoard::pressLimitSwitch(double time_s) {
  advanceTo(time_s);
  if (setting(GrblSettings::kHardLimits) != 0.0 && !boots_at_s_) raiseAlarm(1);
}

std::string GrblBoard::takeOutput() { return std::exchange(output_, {}); }

bool GrblBoard::busy() const {
  return boots_at_s_ || pending_ || motion_.moving() || (!motion_.empty() && !motion_.held());
}

void GrblBoard::advanceTo(double time_s) {
  if (boots_at_s_) {
    if (time_s < *boots_at_s_) return;
    boot();
  }
  settle(time_s);
  work(time_s);
}

void GrblBoard::receive(std::span<const std::byte> bytes, double time_s) {
  advanceTo(time_s);
  if (boots_at_s_) return;
  for (const std::byte byte : bytes) hear(static_cast<char>(byte), time_s);
  work(time_s);
}

// Brings the motion up to the time, and ends what ends with it.
void GrblBoard::settle(double time_s) {
  motion_.advanceTo(
      time_s, [this](std::int64_t steps) { shaft_->setSteps(shaft_at_zero_ + sign() * steps); });
  turnShaft();
  if (motion_.moving()) return;
  if (cancelling_jog_) {
    motion_.flush();
    readPositionBack();
    cancelling_jog_ = false;
  }
  if (motion_.empty()) jogging_ = false;
}

// Realtime characters act at once, wherever they stand in the stream.
void GrblBoard::hear(char c, double time_s) {
  constexpr char kSoftReset = 0x18;
  constexpr char kJogCancel = static_cast<char>(0x85);
  const bool controls_motion = c == '!' || c == '~' || c == kJogCancel;
  settle(time_s);
  if (boots_at_s_) return;
  if (c == kSoftReset) {
    softReset(time_s);
    return;
  }
  if (needs_reset_) return;
  if (c == '?') {
    say(statusReport());
  } else if (asleep_ || (alarm_ && controls_motion)) {
    return;
  } else if (c == '!' || c == kJogCancel) {
    if (jogging_) cancelling_jog_ = true;
    if (jogging_ || c == '!') motion_.hold(time_s);
    settle(time_s);
  } else if (c == '~') {
    if (motion_.held() && !motion_.moving()) motion_.resume(time_s);
  } else if (static_cast<unsigned char>(c) < 0x80 && received_.size() < kReceiveBuffer_bytes) {
    received_ += c;
    if (c == '\n' || c == '\r') work(time_s);
  }
}

// Answers lines one after the other until one has to wait.
void GrblBoard::work(double time_s) {
  while (!needs_reset_ && !asleep_) {
    if (pending_ && !finish(*pending_, time_s)) return;
    if (std::exchange(pending_, std::nullopt)) say("ok");
    const std::size_t end = received_.find_first_of("\r\n");
    if (end == std::string::npos) return;
    const std::string line = received_.substr(0, end);
    received_.erase(0, end + 1);
    obey(line);
  }
}

// A move waits for room in the queue; a dwell waits for the queue to run empty, then its time.
bool GrblBoard::finish(Pending& pending, double time_s) {
  if (pending.command.kind == GcodeCommand::Kind::kMove) {
    if (motion_.full()) return false;
    plan(pending.command, pending.jog, time_s);
    return true;
  }
  if (!pending.until_s) {
    if (inMotion()) return false;
    pending.until_s = time_s + pending.command.dwell_s;
  }
  return time_s >= *pending.until_s;
}

void GrblBoard::obey(std::string_view line) {
  int error = line.size() > kLongestLine ? kLineTooLong : 0;
  std::string words;
  bool in_comment = false;
  for (const char c : line) {
    if (c == ';') break;
    if (c == '(') in_comment = true;
    if (!in_comment && c != ' ' && c != '\t') {
      words += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    }
    if (c == ')') in_comment = false;
  }
  if (error == 0 && words.starts_with('$')) {
    error = obeySystem(words);
  } else if (error == 0 && !words.empty()) {
    GcodeCommand command;
    error = alarm_ || jogging_ ? kLocked : readGcode(words, gcode_, command);
    if (error == 0) error = take(error, command, false);
  }
  if (error != 0) {
    say("error:" + std::to_string(error));
  } else if (!pending_ && !needs_reset_) {
    say("ok");
    if (asleep_) say("[MSG:Sleeping]");
  }
}

bool GrblBoard::outOfTravel(const GcodeCommand& command) const {
  return setting(GrblSettings::kSoftLimits) != 0.0 && command.kind == GcodeCommand::Kind::kMove &&
         (command.target[0] > 0.0 || command.target[0] < -setting(GrblSettings::kMaxTravel));
}

int GrblBoard::take(int error, const GcodeCommand& command, bool jog) {
  if (command.kind == GcodeCommand::Kind::kNothing) return error;
  if (outOfTravel(command)) {
    readPositionBack();
    if (jog) return kTravelExceeded;
    raiseAlarm(2);
    return 0;
  }
  pending_ = Pending{command, jog, {}};
  return 0;
}

void GrblBoard::plan(const GcodeCommand& command, bool jog, double time_s) {
  const double steps_per_unit = setting(GrblSettings::kStepsPerUnit);
  const double feed = command.feed > 0.0 ? std::min(command.feed, setting(GrblSettings::kMaxRate))
                                         : setting(GrblSettings::kMaxRate);
  jogging_ = jog;
  motion_.add({std::llround(command.target[0] * steps_per_unit), feed / 60.0 * steps_per_unit,
               setting(GrblSettings::kAcceleration) * steps_per_unit},
              time_s);
}

int GrblBoard::obeySystem(std::string_view line) {
  if (line == "$") {
    say("[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]");
    return 0;
  }
  if (line.starts_with("$J=")) {
    if (alarm_ || ((inMotion() || motion_.held()) && !jogging_)) return kNotIdle;
    GcodeCommand command;
    if (const int error = readJog(line.substr(3), gcode_, command)) return error;
    return take(0, command, true);
  }
  const bool idle = !inMotion() && !motion_.held();
  if (line == "$X") {
    if (std::exchange(alarm_, false)) say("[MSG:Caution: Unlocked]");
    return 0;
  }
  if (line == "$G") {
    say("[GC:G" + std::to_string(gcode_.motion) + " G54 G17 " + (gcode_.inches ? "G20 " : "G21 ") +
        (gcode_.absolute ? "G90" : "G91") + " G94 M5 M9 T0 F" + fixedText(gcode_.feed, 0) + " S0]");
    return 0;
  }
  if (!idle) return kNotIdle;
  if (line == "$$") {
    output_ += settings_.report();
  } else if (line == "$I") {
    say("[VER:1.1h.20190825:]");
    say("[OPT:V,15,128]");
  } else if (line == "$#") {
    say("[G54:0.000,0.000,0.000]");
    say("[G92:" + fixedText(gcode_.offset[0], 3) + "," + fixedText(gcode_.offset[1], 3) + "," +
        fixedText(gcode_.offset[2], 3) + "]");
  } else if (line == "$N") {
    say("$N0=");
    say("$N1=");
  } else if (line == "$H") {
    return kSettingDisabled;  // a turntable has no switch to search for
  } else if (line == "$SLP") {
    asleep_ = true;
  } else {
    return assign(line);
  }
  return 0;
}

// "$110=3600"
int GrblBoard::assign(std::string_view line) {
  const std::int64_t shaft = shaft_->steps();
  if (const int error = settings_.assign(line)) return error;
  if (setting(GrblSettings::kHoming) == 0.0) alarm_ = alarm_ && !line.starts_with("$22=");
  // A new sign of the direction turns what comes, not what has been.
  shaft_at_zero_ = shaft - sign() * motion_.steps();
  readPositionBack();
  return 0;
}

std::string_view GrblBoard::stateName() const {
  if (asleep_) return "Sleep";
  if (alarm_) return "Alarm";
  if (motion_.held() && !jogging_) return motion_.moving() ? "Hold:1" : "Hold:0";
  if (jogging_ && inMotion()) return "Jog";
  return inMotion() ? "Run" : "Idle";
}

std::string GrblBoard::statusReport() {
  const double scale = setting(GrblSettings::kReportInches) != 0.0 ? 1.0 / 25.4 : 1.0;
  const int decimals = setting(GrblSettings::kReportInches) != 0.0 ? 4 : 3;
  const auto mask = static_cast<unsigned>(setting(GrblSettings::kReportMask));
  const std::array<double, 3> machine = {unitsOf(motion_.steps()), gcode_.position[1],
                                         gcode_.position[2]};
  const auto triple = [&](auto&& value) {
    return fixedText(value(0U) * scale, decimals).append(",") +
           fixedText(value(1U) * scale, decimals) + "," + fixedText(value(2U) * scale, decimals);
  };
  std::string report = "<";
  report += stateName();
  const bool machine_position = (mask & 1U) != 0U;
  report += machine_position ? "|MPos:" : "|WPos:";
  report += triple([&](std::size_t axis) {
    return machine.at(axis) - (machine_position ? 0.0 : gcode_.offset.at(axis));
  });
  if ((mask & 2U) != 0U) {
    report += "|Bf:" + std::to_string(motion_.room()) + "," +
              std::to_string(kReceiveBuffer_bytes - received_.size());
  }
  report +=
      "|FS:" + fixedText(motion_.speed() * 60.0 / setting(GrblSettings::kStepsPerUnit) * scale, 0) +
      ",0";
  // The work offset is told now and then only, the first time at once.
  if (reports_++ % 10 == 0) {
    report += "|WCO:" + triple([&](std::size_t axis) { return gcode_.offset.at(axis); });
  }
  return report.append(">");
}

}  // namespace gyre
