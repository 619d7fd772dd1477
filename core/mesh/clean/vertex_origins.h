// Finds vertices of a mesh again by their exact place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/scan/mesh.h"

namespace gyre {

// For surfaces that a library made of a mesh: it may number what stays in place anew. The mesh
// outlives this. Reading is safe from any thread.
class VertexOrigins {
 public:
  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

  explicit VertexOrigins(const Mesh& mesh);

  const Mesh& mesh() const { return mesh_; }

  // The vertex whose position is the same to the last bit, or kNone.
  std::uint32_t at(const Eigen::Vector3d& place) const;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> order_;  // by place
};

}  // namespace gyre
