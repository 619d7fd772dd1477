// Finds the underside of an object where it hangs over the table and was only guessed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// The platter, z = 0, or the lowest place of a mesh that reaches below it. [mm], table frame
double tableLevel_mm(const Mesh& mesh);

// The triangles with a corner that no camera saw that look down and do not lie on the table's
// level, in patches that hang together by edges and reach over at least this share of the mesh's
// diagonal; ascending.
std::vector<std::uint32_t> guessedUnderside(const Mesh& mesh, double min_share);

}  // namespace gyre
