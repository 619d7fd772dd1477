// Text that may stand in HTML and SVG.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace gyre {

// Characters that mean something to a browser, spelled out.
std::string xmlText(std::string_view text);

}  // namespace gyre
