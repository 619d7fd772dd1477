// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/option_words.h"

#include <variant>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace gyre {
namespace {

std::string helpOf(const Option& option) {
  const std::string unit = option.info.unit.empty() ? "" : " " + option.info.unit;
  return option.info.text + " (default " + option.valueText() + unit + ")";
}

}  // namespace

void addOptionWords(CLI::App& command, const OptionList& options, const std::string& group) {
  for (const Option& option : options.options()) {
    const auto take = [option](const std::string& text) {
      if (const auto set = option.setFromText(text); !set) {
        throw CLI::ValidationError(set.error().sentence());
      }
    };
    command.add_option_function<std::string>("--" + option.info.name, take, helpOf(option))
        ->group(group);
  }
}

void addOptionWords(CLI::App& command, const OptionList& options,
                    std::span<const std::string_view> names, const std::string& group) {
  OptionList said;
  for (const std::string_view name : names) {
    if (command.get_option_no_throw("--" + std::string(name)) != nullptr) continue;
    const Option& option = *options.find(std::string(name));
    std::visit([&](auto* field) { said(option.info, *field); }, option.field);
  }
  addOptionWords(command, said, group);
}

}  // namespace gyre
