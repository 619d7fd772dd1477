// Marks surface that was made where no camera looked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// A vertex that no camera saw and whose accuracy nobody knows.
MeshVertex unseenVertex(const Eigen::Vector3d& position, const Rgb& rgb);

// A triangle is unseen where a corner is: so each of these triangles whose corners are all seen is
// divided at its middle by an unseen vertex. Neighbours stay as they are.
void divideSeenTriangles(Mesh& mesh, std::span<const std::uint32_t> triangles);

// The same for all triangles from `first` on.
void divideSeenTriangles(Mesh& mesh, std::uint32_t first);

// The triangles whose corners are all seen though their middle lies on unseen surface of the
// source: large ones over a base that is all corners. Ascending; the same for any number of
// threads. The source has triangles.
std::vector<std::uint32_t> seenOverUnseen(const Mesh& source, const Mesh& mesh);

}  // namespace gyre
