// A surface of which some patches, its guessed underside, may be shaped; all else stays.
// Only for the .cpp files of this folder.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "core/base/task.h"
#include "core/mesh/clean/plate_heights.h"
#include "core/mesh/clean/rim_slopes.h"
#include "core/mesh/clean/vertex_origins.h"
#include "core/scan/mesh.h"

namespace gyre {

class UndersidePatches {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Vertex = SurfaceMesh::Vertex_index;
  using Face = SurfaceMesh::Face_index;
  using Edge = SurfaceMesh::Edge_index;
  using Places = std::vector<Eigen::Vector3d>;

  // Of the mesh of the origins, which outlive this and have passed checkSurface, these triangles.
  UndersidePatches(const VertexOrigins& origins, const std::vector<std::uint32_t>& triangles,
                   double edge_mm);
  UndersidePatches(const UndersidePatches& other);
  UndersidePatches& operator=(const UndersidePatches&) = delete;
  ~UndersidePatches() = default;

  const SurfaceMesh& surface() const { return surface_; }
  bool isIn(Face face) const { return in_[face] != 0; }
  // Whether it is not inside a patch, or was measured.
  bool isFixed(Vertex vertex) const { return fixed_[vertex]; }
  std::vector<Vertex> inner() const;  // those that are not fixed
  // Of the mesh, the vertex that is still in its place; kNone for a new one.
  std::uint32_t originOf(Vertex vertex) const;

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
  void addProperties();
  bool isInside(SurfaceMesh::Halfedge_index half) const;
  bool isMeasured(Vertex vertex) const;
  void findRim();
  void spreadFromRim();
  std::vector<Face> facesIn() const;
  std::vector<Face> facesNear() const;
  Bounds boundsOfFace(Face face) const;
  Eigen::Vector3d placeOf(Vertex vertex) const;
  Eigen::Vector3d normalOf(Face face) const;
  Eigen::Vector3d middleOf(Face face) const;
  void lift(Vertex vertex, double to_mm);
  Plate plateOf(const RimSlopes& slopes);
  void yield(const std::vector<Vertex>& vertices, const Places& crossed,
             std::vector<double>& share) const;

  SurfaceMesh surface_;
  const VertexOrigins& origins_;
  double level_mm_;                            // of the table
  double edge_mm_;                             // of the new triangles
  SurfaceMesh::Property_map<Face, int> in_;    // 1: in a patch
  SurfaceMesh::Property_map<Edge, bool> rim_;  // a patch on one side
  SurfaceMesh::Property_map<Vertex, bool> fixed_;
  SurfaceMesh::Property_map<Vertex, std::uint32_t> number_;  // among the places of the plate
};

}  // namespace gyre
