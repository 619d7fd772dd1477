// The program's version.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace gyre {

// As CMake's project() has it: "0.1.0".
const char* programVersion();

}  // namespace gyre
