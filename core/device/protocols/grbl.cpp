// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/grbl.h"

#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/check.h"
#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr std::size_t kLongestLine = 256;

template <class Number>
std::optional<Number> numberIn(std::string_view text) {
  Number value{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> finiteIn(std::string_view text) {
  const std::optional<double> value = numberIn<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// The text up to the separator, which is taken off with it.
std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return part;
}

std::optional<std::vector<double>> positionIn(std::string_view text) {
  std::vector<double> position;
  while (!text.empty()) {
    const std::optional<double> value = finiteIn(cut(text, ','));
    if (!value) return std::nullopt;
    position.push_back(*value);
  }
  if (position.empty()) return std::nullopt;
  return position;
}

std::optional<GrblState> stateIn(std::string_view name) {
  static const std::map<std::string_view, GrblState> kStates = {
      {"Idle", GrblState::kIdle},   {"Run", GrblState::kRun},     {"Hold", GrblState::kHold},
      {"Jog", GrblState::kJog},     {"Alarm", GrblState::kAlarm}, {"Door", GrblState::kDoor},
      {"Check", GrblState::kCheck}, {"Home", GrblState::kHome},   {"Sleep", GrblState::kSleep}};
  const auto found = kStates.find(name);
  if (found == kStates.end()) return std::nullopt;
  return found->second;
}

// What stands between < and >. Unknown fields are other firmwares' additions and are skipped.
std::optional<GrblStatus> statusIn(std::string_view text) {
  GrblStatus status;
  std::string_view head = cut(text, '|');
  const std::optional<GrblState> state = stateIn(cut(head, ':'));
  if (!state) return std::nullopt;
  status.state = *state;
  if (!head.empty()) {
    status.substate = numberIn<int>(head);
    if (!status.substate) return std::nullopt;
  }
  while (!text.empty()) {
    std::string_view value = cut(text, '|');
    const std::string_view name = cut(value, ':');
    if (name != "MPos" && name != "WPos" && name != "WCO") continue;
    std::optional<std::vector<double>> position = positionIn(value);
    if (!position) return std::nullopt;
    std::vector<double>& field = name == "MPos"   ? status.machine
                                 : name == "WPos" ? status.work
                                                  : status.work_offset;
    field = *std::move(position);
  }
  if (status.machine.empty() && status.work.empty()) return std::nullopt;
  return status;
}

std::optional<GrblMessage> numbered(GrblMessage::Kind kind, std::string_view digits) {
  const std::optional<int> number = numberIn<int>(digits);
  if (!number) return std::nullopt;
  GrblMessage message;
  message.kind = kind;
  message.number = *number;
  return message;
}

// "$100=8.889"
std::optional<GrblMessage> settingIn(std::string_view line) {
  line.remove_prefix(1);
  std::optional<GrblMessage> message = numbered(GrblMessage::Kind::kSetting, cut(line, '='));
  const std::optional<double> value = finiteIn(line);
  if (!message || !value) return std::nullopt;
  message->value = *value;
  return message;
}

std::optional<GrblMessage> messageIn(std::string_view line) {
  using Kind = GrblMessage::Kind;
  GrblMessage message;
  message.text = line;
  if (line == "ok") {
    message.kind = Kind::kOk;
    return message;
  }
  if (line.starts_with("error:")) return numbered(Kind::kError, line.substr(6));
  if (line.starts_with("ALARM:")) return numbered(Kind::kAlarm, line.substr(6));
  if (line.starts_with("<") && line.ends_with(">")) {
    std::optional<GrblStatus> status = statusIn(line.substr(1, line.size() - 2));
    if (!status) return std::nullopt;
    message.kind = Kind::kStatus;
    message.status = *std::move(status);
    return message;
  }
  // grblHAL calls itself "GrblHAL 1.1f ['$' or '$HELP' for help]".
  if ((line.starts_with("Grbl ") || line.starts_with("GrblHAL ")) && line.ends_with("]")) {
    message.kind = Kind::kBanner;
    return message;
  }
  if (line.starts_with("$")) return settingIn(line);
  if ((line.starts_with("[") && line.ends_with("]")) || line.starts_with(">")) {
    message.kind = Kind::kFeedback;
    return message;
  }
  return std::nullopt;
}

std::string described(std::string_view word, int number, const std::map<int, std::string>& texts) {
  const auto found = texts.find(number);
  const std::string name = std::string(word) + " " + std::to_string(number);
  return found == texts.end() ? name : name + ": " + found->second;
}

}  // namespace

GrblMessage parseGrblLine(std::string_view line) {
  if (std::optional<GrblMessage> message = messageIn(line)) return *std::move(message);
  GrblMessage garbage;
  garbage.text = line;
  return garbage;
}

void GrblParser::feed(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    const char c = static_cast<char>(byte);
    if (c != '\n' && c != '\r') {
      overlong_ |= line_.size() >= kLongestLine;
      if (!overlong_) line_ += c;
      continue;
    }
    if (overlong_) {
      messages_.push_back({GrblMessage::Kind::kGarbage, 0, 0.0, line_, {}});
    } else if (!line_.empty()) {
      messages_.push_back(parseGrblLine(line_));
    }
    line_.clear();
    overlong_ = false;
  }
}

std::optional<GrblMessage> GrblParser::next() {
  if (messages_.empty()) return std::nullopt;
  GrblMessage message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

std::string grblMove(char axis, double target, double feed) {
  // G53: a machine position, whatever offsets somebody has set; G21 G90 G94: whatever modes.
  // A table whose unit is a turn moves at well below one unit a minute.
  return formatted(feed < 10.0 ? "G21G90G94G53G1%c%.4fF%.4f" : "G21G90G94G53G1%c%.4fF%.1f", axis,
                   target, feed);
}

std::size_t grblAxisIndex(char axis) {
  const std::size_t index = std::string_view("XYZABC").find(axis);
  GYRE_CHECK(index != std::string_view::npos);
  return index;
}

std::string grblErrorText(int number) {
  return described("error", number,
                   {{1, "a letter was expected"},
                    {2, "a number is malformed"},
                    {3, "the $ command is not known"},
                    {4, "a value must not be negative"},
                    {5, "homing is switched off"},
                    {8, "it only does that when idle"},
                    {9, "it is locked by an alarm or a jog"},
                    {11, "the line is too long"},
                    {15, "the target lies beyond the travel allowed by its soft limits"},
                    {20, "the command is not supported"},
                    {22, "the feed rate is missing"}});
}

std::string grblAlarmText(int number) {
  return described("alarm", number,
                   {{1, "a limit switch was hit"},
                    {2, "the target lies beyond the travel allowed by its soft limits"},
                    {3, "it was reset while turning"},
                    {4, "the probe was not in its expected state"},
                    {5, "the probe made no contact"},
                    {6, "homing was reset"},
                    {7, "the door was opened while homing"},
                    {8, "homing could not leave the switch"},
                    {9, "homing found no switch"}});
}

}  // namespace gyre
