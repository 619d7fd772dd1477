// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/grbl_handshake.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

namespace gyre {
namespace {

constexpr double kStatus_s = 0.6;
constexpr double kQuery_s = 1.0;
// From a reset to the banner: half a second after an alarm, and up to 255 ms to let go of the
// motor.
constexpr double kRestart_s = 1.5;
constexpr double kSlice_s = 0.02;
constexpr int kTries = 4;
constexpr double kOldestVersion = 1.1;

// The banner, once it comes; nothing when it does not.
Result<std::optional<std::string>> awaitBanner(GrblLink& link, double timeout_s,
                                               const Interrupted& interrupted) {
  const double deadline_s = link.now() + timeout_s;
  while (link.now() < deadline_s) {
    if (interrupted && interrupted()) return cancelled();
    const Result<std::optional<GrblMessage>> message = link.receive(kSlice_s);
    if (!message) return message.error();
    if (*message && (*message)->kind == GrblMessage::Kind::kBanner) {
      return std::optional<std::string>((*message)->text);
    }
  }
  return std::optional<std::string>();
}

Error nobody(const GrblLink& link) {
  if (link.garbage().empty()) {
    return {Error::Code::kTimeout, "Nothing answers on " + link.name() + ".",
            "Check that the board has power and that this is its port."};
  }
  std::string heard;
  for (const char c : link.garbage().substr(0, 60)) heard += c >= ' ' && c <= '~' ? c : '.';
  return {Error::Code::kWrongDevice,
          "The device on " + link.name() + " does not speak GRBL; it says \"" + heard + "\".",
          "Choose another port, or put GRBL 1.1, grblHAL or FluidNC on the board (115200 baud)."};
}

// What must not be reset: a reset in motion loses the position, one in a pause the job.
std::optional<Error> atWork(const GrblLink& link, const GrblStatus& status) {
  const int part = status.substate.value_or(0);
  const bool slows_down = status.state == GrblState::kHold && part != 0;
  const bool moves_at_door = status.state == GrblState::kDoor && part >= 2;
  if (slows_down || moves_at_door || status.state == GrblState::kRun ||
      status.state == GrblState::kJog || status.state == GrblState::kHome) {
    return Error{Error::Code::kBusy, "The board on " + link.name() + " is moving already.",
                 "Stop what drives it, then connect again."};
  }
  if (status.state == GrblState::kHold) {
    return Error{
        Error::Code::kBusy, "The board on " + link.name() + " holds work that was paused.",
        "Finish or cancel that work; when this is your turntable, switch its board off and "
        "on. Then connect again."};
  }
  return std::nullopt;
}

// Asks until a banner is heard.
Result<std::string> greet(GrblLink& link, double greeting_s, const Interrupted& interrupted) {
  Result<std::optional<std::string>> banner = awaitBanner(link, greeting_s, interrupted);
  if (!banner) return banner.error();
  if (*banner) return **std::move(banner);
  const Result<GrblStatus> status = link.status(kStatus_s, interrupted);
  if (const std::optional<Error> work = status ? atWork(link, *status) : std::nullopt) return *work;
  if (!status && status.error().code != Error::Code::kTimeout &&
      status.error().code != Error::Code::kAlarm) {
    return status.error();
  }
  if (const Result<void> sent = link.send(std::string_view(&kGrblSoftReset, 1)); !sent) {
    return sent.error();
  }
  banner = awaitBanner(link, std::max(greeting_s, kRestart_s), interrupted);
  if (!banner) return banner.error();
  if (*banner) return **std::move(banner);
  return nobody(link);
}

// "Grbl 1.1h ['$' for help]" -> "Grbl 1.1h"; "Grbl 3.7 [FluidNC v3.7 '$' for help]" -> "FluidNC
// v3.7".
std::string firmwareName(const std::string& banner) {
  const std::size_t bracket = banner.find(" [");
  const std::size_t quote = banner.find('\'', bracket);
  if (bracket != std::string::npos && quote != std::string::npos && quote > bracket + 3) {
    return banner.substr(bracket + 2, quote - bracket - 3);
  }
  return banner.substr(0, bracket);
}

double versionIn(const std::string& banner) {
  const std::string number = banner.substr(banner.find(' ') + 1);
  double version = 0.0;
  const auto parsed = std::from_chars(number.data(), number.data() + number.size(), version);
  return parsed.ec == std::errc() ? version : 0.0;
}

// A question that may be asked again: until an answer comes through unharmed.
Result<std::vector<GrblMessage>> ask(GrblLink& link, std::string_view line,
                                     const Interrupted& interrupted) {
  Result<std::vector<GrblMessage>> answer = std::vector<GrblMessage>();
  for (int i = 0; i < kTries; ++i) {
    answer = link.query(line, kQuery_s, interrupted);
    if (answer) return answer;
    const Error::Code code = answer.error().code;
    if (code != Error::Code::kTimeout && code != Error::Code::kRejected) return answer;
    // What is left of a spoilt line would spoil the next one.
    if (const Result<void> sent = link.send("\n"); !sent) return sent.error();
    if (const Result<void> quiet = link.drain(); !quiet) return quiet.error();
  }
  return answer;
}

Result<std::map<int, double>> readSettings(GrblLink& link, const Interrupted& interrupted) {
  std::map<int, double> previous;
  for (int i = 0; i < 2 * kTries; ++i) {
    const Result<std::vector<GrblMessage>> said = ask(link, "$$", interrupted);
    if (!said) return said.error();
    std::map<int, double> settings;
    for (const GrblMessage& message : *said) {
      if (message.kind == GrblMessage::Kind::kSetting) settings[message.number] = message.value;
    }
    // A digit spoilt on the wire would falsify every angle: only what was read twice is believed.
    if (i > 0 && settings == previous) return settings;
    previous = std::move(settings);
  }
  return Error{Error::Code::kIo,
               "The settings of the board on " + link.name() + " arrive differently each time.",
               "Use a shorter or better shielded cable."};
}

}  // namespace

Result<GrblBoardInfo> identifyGrbl(GrblLink& link, double greeting_s,
                                   const Interrupted& interrupted) {
  const Result<std::string> banner = greet(link, greeting_s, interrupted);
  if (!banner) return banner.error();
  if (const Result<void> quiet = link.drain(); !quiet) return quiet.error();
  link.forgiveTrouble();
  GrblBoardInfo info;
  info.firmware = firmwareName(*banner);
  if (versionIn(*banner) < kOldestVersion) {
    return Error{Error::Code::kWrongDevice,
                 "The board's firmware, " + info.firmware + ", is too old.", "Put GRBL 1.1 on it."};
  }
  const Result<std::vector<GrblMessage>> build = ask(link, "$I", interrupted);
  if (!build) return build.error();
  Result<std::map<int, double>> settings = readSettings(link, interrupted);
  if (!settings) return settings.error();
  info.settings = *std::move(settings);
  return info;
}

}  // namespace gyre
