// Makes four triangles of each.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scan/mesh.h"

namespace gyre {

// The same surface with a new vertex in the middle of every edge; old vertices keep their numbers.
Mesh quartered(const Mesh& mesh);

}  // namespace gyre
