// Writes a surface or a cloud with its distance from another one: as numbers and as colours.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "core/scan/mesh.h"

namespace gyre {

// The bytes of a binary PLY, little endian: float x y z (mm, as they lie), uchar red green blue
// (the vertices' own), float quality (the distance in mm: MeshLab's and CloudCompare's scalar
// field), and the faces, where there are any. One distance a vertex. scale: what the colours mean,
// for a comment in the header; without line breaks.
std::string distancePlyBytes(const Mesh& mesh, std::span<const double> distances_mm,
                             const std::string& scale);

}  // namespace gyre
