// Numbers in sentences, in files and on the wire, the same in every country.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace gyre {

/// What printf would write, but always with a decimal point: a window takes over the user's locale
/// for the whole process, and half of the world writes 0,5 there, which no board understands.
/// The compiler checks the values against the format. Any thread.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// Pixels as they are told: two digits below ten, whole ones above ("0.42 px", "3.0 px", "17 px").
std::string pxText(double px);

}  // namespace gyre
