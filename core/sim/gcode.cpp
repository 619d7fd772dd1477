// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/gcode.h"

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace gyre {
namespace {

// Numbers of grbl/doc/csv/error_codes_en_US.csv.
constexpr int kExpectedLetter = 1;
constexpr int kBadNumber = 2;
constexpr int kNegativeValue = 4;
constexpr int kInvalidJog = 16;
constexpr int kUnsupported = 20;
constexpr int kModalGroup = 21;
constexpr int kNoFeed = 22;
constexpr int kNotInteger = 23;
constexpr int kWordRepeated = 25;
constexpr int kNoAxisWords = 26;
constexpr int kValueMissing = 28;
constexpr int kG53NeedsMotion = 30;
constexpr int kUnusedAxisWords = 31;

constexpr double kMmPerInch = 25.4;

// Modal groups, as far as they can collide here.
enum class Group { kMotion, kPlane, kDistance, kUnits, kOther, kNonModal };

struct Words {
  std::vector<int> g_tenths;  // G92.1 is 921
  std::map<char, double> values;
  bool hasAxis() const {
    return values.contains('X') || values.contains('Y') || values.contains('Z');
  }
};

std::optional<Group> groupOf(int g_tenths) {
  switch (g_tenths) {
    case 0:
    case 10:
    case 800:
      return Group::kMotion;
    case 40:
    case 530:
    case 920:
    case 921:
      return Group::kNonModal;
    case 170:
    case 180:
    case 190:
      return Group::kPlane;
    case 200:
    case 210:
      return Group::kUnits;
    case 900:
    case 910:
      return Group::kDistance;
    case 400:
    case 490:
    case 540:
    case 610:
    case 911:
    case 940:
      return Group::kOther;
    default:
      return std::nullopt;
  }
}

bool isHarmlessM(double value) {
  static const std::set<double> kKnown = {0, 1, 2, 3, 4, 5, 8, 9, 30};
  return kKnown.contains(value);
}

int addWord(char letter, double value, Words& words, std::set<Group>& groups) {
  if (letter == 'G') {
    const int tenths = static_cast<int>(std::lround(value * 10.0));
    const std::optional<Group> group = groupOf(tenths);
    if (!group) return kUnsupported;
    // G53 accompanies a motion and belongs to no group of its own here.
    if (*group != Group::kOther && tenths != 530 && !groups.insert(*group).second) {
      return kModalGroup;
    }
    words.g_tenths.push_back(tenths);
    return 0;
  }
  if (letter == 'M') {
    if (value != std::floor(value)) return kNotInteger;
    return isHarmlessM(value) ? 0 : kUnsupported;
  }
  if (std::string_view("FNPSTXYZ").find(letter) == std::string_view::npos) return kUnsupported;
  if (!words.values.emplace(letter, value).second) return kWordRepeated;
  if (value < 0.0 && std::string_view("FNPST").find(letter) != std::string_view::npos) {
    return kNegativeValue;
  }
  return 0;
}

int readWords(std::string_view line, Words& words) {
  std::set<Group> groups;
  while (!line.empty()) {
    const char letter = line.front();
    if (letter < 'A' || letter > 'Z') return kExpectedLetter;
    line.remove_prefix(1);
    if (!line.empty() && line.front() == '+') line.remove_prefix(1);
    double value = 0.0;
    const auto [end, failure] =
        std::from_chars(line.data(), line.data() + line.size(), value, std::chars_format::fixed);
    if (failure != std::errc() || !std::isfinite(value)) return kBadNumber;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (const int error = addWord(letter, value, words, groups)) return error;
  }
  return 0;
}

// Words that only set what is in force. Returns whether the line has the three non-modal words.
struct NonModal {
  bool dwell = false;
  bool set_offset = false;
  bool clear_offset = false;
  bool machine = false;  // G53
  bool motion = false;   // G0 or G1 stands in the line
};

NonModal applyModes(const Words& words, GcodeState& state) {
  NonModal found;
  for (const int g : words.g_tenths) {
    if (g == 0 || g == 10 || g == 800) state.motion = g / 10;
    if (g == 200 || g == 210) state.inches = g == 200;
    if (g == 900 || g == 910) state.absolute = g == 900;
    found.dwell |= g == 40;
    found.set_offset |= g == 920;
    found.clear_offset |= g == 921;
    found.machine |= g == 530;
    found.motion |= g == 0 || g == 10;
  }
  return found;
}

std::array<double, 3> targetOf(const Words& words, const GcodeState& state, bool machine) {
  const double scale = state.inches ? kMmPerInch : 1.0;
  std::array<double, 3> target = state.position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto word = words.values.find("XYZ"[axis]);
    if (word == words.values.end()) continue;
    const double value = word->second * scale;
    if (machine) {
      target.at(axis) = value;
    } else {
      target.at(axis) = value + (state.absolute ? state.offset.at(axis) : state.position.at(axis));
    }
  }
  return target;
}

int applyMotion(const Words& words, const NonModal& found, GcodeState& state,
                GcodeCommand& command) {
  if (found.motion && state.motion == 1 && !words.hasAxis()) return 0;  // G1 alone sets the mode
  if (!words.hasAxis()) return 0;
  if (state.motion == 80) return kUnusedAxisWords;
  if (state.motion == 1 && state.feed <= 0.0) return kNoFeed;
  command.kind = GcodeCommand::Kind::kMove;
  command.target = targetOf(words, state, found.machine);
  command.feed = state.motion == 1 ? state.feed : 0.0;
  state.position = command.target;
  return 0;
}

int apply(const Words& words, GcodeState& state, GcodeCommand& command) {
  const NonModal found = applyModes(words, state);
  if (const auto feed = words.values.find('F'); feed != words.values.end()) {
    state.feed = feed->second * (state.inches ? kMmPerInch : 1.0);
  }
  if (found.machine && state.motion == 80) return kG53NeedsMotion;
  if (found.dwell) {
    const auto pause = words.values.find('P');
    if (pause == words.values.end()) return kValueMissing;
    command.kind = GcodeCommand::Kind::kDwell;
    command.dwell_s = pause->second;
    return words.hasAxis() ? kUnusedAxisWords : 0;
  }
  if (found.set_offset) {
    if (!words.hasAxis()) return kNoAxisWords;
    GcodeState absolute = state;
    absolute.absolute = true;
    absolute.offset = {};
    const std::array<double, 3> named = targetOf(words, absolute, false);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (words.values.contains("XYZ"[axis])) {
        state.offset.at(axis) = state.position.at(axis) - named.at(axis);
      }
    }
    return 0;
  }
  if (found.clear_offset) {
    state.offset = {};
    return 0;
  }
  return applyMotion(words, found, state, command);
}

}  // namespace

int readGcode(std::string_view line, GcodeState& state, GcodeCommand& command) {
  Words words;
  if (const int error = readWords(line, words)) return error;
  GcodeState next = state;
  command = {};
  if (const int error = apply(words, next, command)) return error;
  state = next;
  return 0;
}

int readJog(std::string_view line, GcodeState& state, GcodeCommand& command) {
  Words words;
  if (const int error = readWords(line, words)) return error;
  for (const int g : words.g_tenths) {
    if (g != 200 && g != 210 && g != 900 && g != 910 && g != 530) return kInvalidJog;
  }
  if (!words.hasAxis()) return kNoAxisWords;
  if (!words.values.contains('F') || words.values.at('F') <= 0.0) return kNoFeed;
  GcodeState jog = state;
  jog.motion = 1;
  command = {};
  if (const int error = apply(words, jog, command)) return error;
  state.position = jog.position;
  return 0;
}

}  // namespace gyre
