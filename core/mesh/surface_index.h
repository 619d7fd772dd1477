// Finds the place on a surface that is nearest to a point.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/scan/mesh.h"

namespace gyre {

// Where a surface comes nearest.
struct SurfaceHit {
  double distance_mm = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // on the surface
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();   // barycentric, of the triangle's corners
  std::uint32_t piece = 0;  // the triangle; the vertex where the mesh has no triangles
};

// A tree of boxes over the triangles of a mesh, or over its vertices when it has no triangles: a
// cloud. The mesh outlives the index and has at least one vertex. Reading is safe from any thread.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const Mesh& mesh);

  SurfaceHit nearest(const Eigen::Vector3d& place) const;

  // How many views saw the surface there, blended between the triangle's corners.
  double viewsAt(const SurfaceHit& hit) const;
  // Unit normal of the triangle there; zero when it has no area or the mesh has no triangles.
  Eigen::Vector3d normalAt(const SurfaceHit& hit) const;

 private:
  struct Node {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    std::uint32_t begin = 0;  // range in order_
    std::uint32_t end = 0;
    std::uint32_t right = 0;  // the left child follows its parent; 0 marks a leaf
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end,
                      const std::vector<Eigen::Vector3d>& centres);
  void boundNode(Node& node) const;
  Triangle corners(std::uint32_t piece) const;
  SurfaceHit nearestOnPiece(const Eigen::Vector3d& place, std::uint32_t piece) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace gyre
