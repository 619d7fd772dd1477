// The words of a command that cleans up a mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh/clean/options.h"

namespace CLI {
class App;
}

namespace gyre {

// Adds --crop-radius, --z-min, --z-max, --min-component, --keep-pieces, --fill-holes, --base-cap,
// --smooth, --triangles and --remesh, which set the options; what is not said keeps its value. A
// command that has --min-component of its own keeps it. The options must live as long as the
// command.
void addCleanWords(CLI::App& command, CleanOptions& options);

}  // namespace gyre
