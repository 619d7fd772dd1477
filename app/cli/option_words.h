// Words of a command for options that describe themselves.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/option_list.h"

namespace CLI {
class App;
}

namespace gyre {

// One word --NAME an option, listed in --help under the group's name with its unit and default. A
// value that does not fit is wrong use. The options must live as long as the command.
void addOptionWords(CLI::App& command, const OptionList& options, const std::string& group);

// The same for the options of these names, but for words that the command has already.
void addOptionWords(CLI::App& command, const OptionList& options,
                    std::span<const std::string_view> names, const std::string& group);

}  // namespace gyre
