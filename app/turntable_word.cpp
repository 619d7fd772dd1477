// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/turntable_word.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <vector>

#include "core/device/discovery.h"
#include "core/device/find_table.h"

namespace gyre {
namespace {

constexpr int kMostMarks = 100000;
constexpr std::string_view kHand = "hand";
constexpr std::string_view kJson = ".json:";

Result<TurntableWord> byHand(const std::string& word) {
  TurntableWord found;
  if (word == kHand) return found;
  const std::string number = word.substr(kHand.size() + 1);
  if (number == "free") return found;
  const char* end = number.data() + number.size();
  const auto parsed = std::from_chars(number.data(), end, found.marks);
  if (parsed.ec == std::errc() && parsed.ptr == end && found.marks >= 2 &&
      found.marks <= kMostMarks) {
    return found;
  }
  return Error{Error::Code::kInvalidInput,
               "\"" + word + "\" does not say how many marks the table has.",
               "Write hand:36 for marks every ten degrees, or hand:free for a ring of markers."};
}

}  // namespace

Result<TurntableWord> turntableWord(const std::string& word) {
  if (word == kHand || word.starts_with("hand:")) return byHand(word);
  TurntableWord found;
  found.port = word;
  const std::string prefix = word.substr(0, word.find(':'));
  const std::vector<std::string> known = firmwareWords();
  if (const std::size_t at = word.find(kJson); at != std::string::npos) {
    found.description = word.substr(0, at + kJson.size() - 1);
    found.port = word.substr(at + kJson.size());
  } else if (prefix != word && std::find(known.begin(), known.end(), prefix) != known.end()) {
    found.firmware = prefix;
    found.port = word.substr(prefix.size() + 1);
  }
  if (!found.port.empty()) return found;
  return Error{Error::Code::kInvalidInput, "\"" + word + "\" names no port.",
               "Write the port after the colon, such as marlin:/dev/ttyUSB0."};
}

std::string lastingTurntableWord(const std::string& word) {
  const auto parsed = turntableWord(word);
  if (!parsed || parsed->port.empty()) return word;
  std::string port = parsed->port;
  if (!parsed->isNetwork()) {
    const std::string stable = stablePathOf(port);
    if (!stable.empty()) port = stable;
  }
  if (!parsed->firmware.empty()) return parsed->firmware + ":" + port;
  if (parsed->description.empty()) return port;
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(parsed->description, failed);
  return (failed ? parsed->description : whole).string() + ":" + port;
}

}  // namespace gyre
