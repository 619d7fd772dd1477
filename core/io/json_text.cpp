// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

namespace gyre {
namespace {

using nlohmann::json;

// The word NaN or Infinity outside quotation marks, or nothing.
std::string_view notANumber(std::string_view text) {
  bool in_quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && in_quotes) {
      ++i;
    } else if (text[i] == '"') {
      in_quotes = !in_quotes;
    } else if (!in_quotes) {
      for (const std::string_view word : {"NaN", "nan", "Infinity", "inf"}) {
        if (text.substr(i, word.size()) == word) return word;
      }
    }
  }
  return {};
}

std::string lineAt(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  return std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
}

}  // namespace

Result<void> checkJson(std::string_view text, const std::string& file) {
  try {
    [[maybe_unused]] const json parsed = json::parse(text);
    return {};
  } catch (const json::parse_error& error) {
    const std::string_view word = notANumber(text);
    if (!word.empty()) {
      return Error{
          Error::Code::kInvalidInput,
          "The file \"" + file + "\" holds " + std::string(word) + " where a number must be.",
          "Make the file anew with the program that wrote it."};
    }
    return Error{
        Error::Code::kInvalidInput,
        "The file \"" + file + "\" is damaged: line " + lineAt(text, error.byte) + " is not JSON.",
        "Correct that line or make the file anew."};
  } catch (const json::exception&) {  // a number beyond the range of double
    return Error{Error::Code::kInvalidInput,
                 "The file \"" + file + "\" holds a number that is too large.",
                 "Make the file anew with the program that wrote it."};
  }
}

std::string jsonNumber(double value) {
  std::array<char, 32> digits{};
  const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  static_cast<void>(problem);  // 32 characters hold every double
  std::string text(digits.data(), end);
  // Without a point, a reader takes -0 for the integer 0 and loses its sign.
  if (text == "-0") text = "-0.0";
  return text;
}

std::string jsonString(std::string_view text) {
  return json(std::string(text)).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace gyre
