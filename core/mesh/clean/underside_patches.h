// A surface of which some patches, its guessed underside, may be shaped; all else stays.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/base/task.h"
#include "core/mesh/clean/rim_slopes.h"
#include "core/mesh/clean/vertex_origins.h"
#include "core/scan/mesh.h"

namespace gyre {

struct ShapedSurface {
  Mesh mesh;                           // vertices have a position only
  std::vector<char> fixed;             // of each vertex: not inside a patch, or measured
  std::vector<std::uint32_t> origins;  // of each vertex: where it was before, kNone for a new place
  std::vector<std::uint32_t> patches;  // the triangles of the patches, ascending
};

class UndersidePatches {
 public:
  using Places = std::vector<Eigen::Vector3d>;

  // Of the mesh of the origins, which outlive this and have passed checkSurface, these triangles.
  UndersidePatches(const VertexOrigins& origins, const std::vector<std::uint32_t>& triangles,
                   double edge_mm);
  UndersidePatches(const UndersidePatches& other);
  UndersidePatches(UndersidePatches&& other) noexcept;
  UndersidePatches& operator=(const UndersidePatches&) = delete;
  UndersidePatches& operator=(UndersidePatches&&) = delete;
  ~UndersidePatches();

  std::size_t inner() const;  // how many vertices may be moved
  ShapedSurface surface() const;

  // Divides long edges between the rims; the surface stays where it is.
  void divide();
  // Makes the triangles even. Throws what the library throws.
  void even();
  // Takes what lies near these places out of the patches.
  void spare(const Places& places);

  // Where a patch crosses itself or other surface.
  Places crossings() const;
  // Where a patch no longer looks down, or where what was measured has gone.
  Places spoilt() const;

  // Bends the patches up and down, as plates that go on as the slopes tell, less near what they
  // would cross; tells how far at most. Zero where they still crossed more often than `allowed`.
  double bend(const RimSlopes& slopes, std::size_t allowed, const Task& task);

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

}  // namespace gyre
