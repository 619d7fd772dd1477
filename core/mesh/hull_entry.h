// Where rays from one camera enter the hull of the points.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/tetrahedra.h"

namespace gyre {

// The facets of the hull that face a camera, sorted into a grid in its picture. Reading is safe
// from any thread; the triangulation outlives it.
class HullEntry {
 public:
  HullEntry(const Tetrahedra& tetrahedra, const Eigen::Vector3d& camera);

  struct Place {
    std::uint32_t cell = 0;  // infinite, beyond the hull
    int side = 0;            // that leads into it
  };

  // Nothing when the ray from the camera misses the hull, or when the camera is inside.
  std::optional<Place> of(const Eigen::Vector3d& direction) const;

 private:
  struct Facet {
    std::array<Eigen::Vector2d, 3> corners;  // in the picture
    Place place;
  };

  std::optional<Eigen::Vector2d> inPicture(const Eigen::Vector3d& direction) const;
  std::array<int, 2> bucketOf(const Eigen::Vector2d& spot) const;
  void addToGrid(std::uint32_t facet);

  Eigen::Matrix3d picture_from_table_ = Eigen::Matrix3d::Identity();
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d buckets_per_unit_ = Eigen::Vector2d::Zero();
  std::vector<Facet> facets_;
  std::vector<std::vector<std::uint32_t>> grid_;  // facets that may cover each bucket
};

}  // namespace gyre
