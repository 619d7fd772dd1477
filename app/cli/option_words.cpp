// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/option_words.h"

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

}  // namespace gyre
