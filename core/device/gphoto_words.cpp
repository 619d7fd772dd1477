// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/gphoto_words.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace gyre {
namespace {

constexpr std::string_view kNetworkWord = "ptpip:";
constexpr const char* kUsualPort = "15740";  // registered for PTP/IP

// The number at the beginning, whatever the locale; what follows it is left in the text.
double takeNumber(std::string_view& text) {
  double number = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return number;
}

}  // namespace

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool namesJpeg(const std::string& file_name) {
  const std::string name = lowerCase(file_name);
  return name.ends_with(".jpg") || name.ends_with(".jpeg");
}

double numberInWord(const std::string& word) {
  std::string_view rest = word;
  if (rest.starts_with("f/")) rest.remove_prefix(2);
  const double number = takeNumber(rest);
  if (!rest.starts_with('/')) return number;
  rest.remove_prefix(1);
  const double below = takeNumber(rest);
  return below > 0.0 ? number / below : 0.0;
}

std::string ptpIpPortFor(const std::string& word) {
  const std::string rest = word.substr(std::min(kNetworkWord.size(), word.size()));
  const std::size_t colon = std::min(rest.find(':'), rest.size());
  std::string port = rest.substr(std::min(colon + 1, rest.size()));
  port = port.substr(0, port.find(':'));
  if (port.empty()) port = kUsualPort;
  return std::string(kNetworkWord) + rest.substr(0, colon) + ":" + port + ":" + port;
}

}  // namespace gyre
