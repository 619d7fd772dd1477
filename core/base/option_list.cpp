// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/option_list.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <type_traits>

namespace gyre {
namespace {

std::string numberText(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

Error outOfRange(const OptionInfo& info, const std::string& value) {
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  return {
      Error::Code::kInvalidInput, "The option " + info.name + " cannot be " + value + unit + ".",
      "Choose a value from " + numberText(info.min) + " to " + numberText(info.max) + unit + "."};
}

bool inRange(const OptionInfo& info, double value) {
  return std::isfinite(value) && value >= info.min && value <= info.max;
}

template <class Number>
Result<void> setNumber(const OptionInfo& info, const std::string& text, Number& field) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value);
  if (problem != std::errc{} || stop != end) return outOfRange(info, "\"" + text + "\"");
  if (!inRange(info, static_cast<double>(value))) return outOfRange(info, text);
  field = value;
  return {};
}

Result<void> setBool(const OptionInfo& info, const std::string& text, bool& field) {
  if (text != "true" && text != "false") {
    return Error{Error::Code::kInvalidInput,
                 "The option " + info.name + " cannot be \"" + text + "\".",
                 "Write true or false."};
  }
  field = text == "true";
  return {};
}

}  // namespace

std::string Option::valueText() const {
  return std::visit(
      [](const auto* value) -> std::string {
        using Field = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<Field, bool>) {
          return *value ? "true" : "false";
        } else if constexpr (std::is_same_v<Field, std::string>) {
          return *value;
        } else {
          return numberText(static_cast<double>(*value));
        }
      },
      field);
}

Result<void> Option::setFromText(const std::string& text) const {
  return std::visit(
      [&](auto* value) -> Result<void> {
        using Field = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<Field, bool>) {
          return setBool(info, text, *value);
        } else if constexpr (std::is_same_v<Field, std::string>) {
          *value = text;
          return {};
        } else {
          return setNumber(info, text, *value);
        }
      },
      field);
}

const Option* OptionList::find(const std::string& name) const {
  for (const Option& option : options_) {
    if (option.info.name == name) return &option;
  }
  return nullptr;
}

std::map<std::string, std::string> OptionList::texts() const {
  std::map<std::string, std::string> texts;
  for (const Option& option : options_) {
    const std::string unit = option.info.unit.empty() ? "" : " " + option.info.unit;
    texts[option.info.name] = option.valueText() + unit;
  }
  return texts;
}

Result<void> OptionList::validate() const {
  for (const Option& option : options_) {
    const bool fits = std::visit(
        [&](const auto* value) {
          using Field = std::remove_cvref_t<decltype(*value)>;
          if constexpr (std::is_same_v<Field, bool> || std::is_same_v<Field, std::string>) {
            return true;
          } else {
            return inRange(option.info, static_cast<double>(*value));
          }
        },
        option.field);
    if (!fits) return outOfRange(option.info, option.valueText());
  }
  return {};
}

}  // namespace gyre
