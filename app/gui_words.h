// Tells whether the words of the command line ask for the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/gui.h"

namespace gyre {

// words: without the program's name. No words at all, one path of a scan or a model, or
// `--screenshot FILE --scene
// start|doctor|focus|target|calibrate|turn|verdict|place|scan|mesh|clean|merge|measure` in either
// order. Nothing for all others: they are commands.
std::optional<GuiOptions> guiOptions(const std::vector<std::string>& words);

}  // namespace gyre
