// Places on the surface between the points that are known.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/point_surface.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// A place where the surface must pass if it goes on as it does around its parent.
struct SurfaceSeed {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // unit, on the parent's side
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();   // the parent's, see PointSurface
  std::uint32_t parent = 0;
};

// Lays places around points, six around each, about spacing_mm apart on the surface, and never two
// of the same side of a wall nearer than that share of it. One thread at a time.
class SurfaceSeeds {
 public:
  explicit SurfaceSeeds(double spacing_mm);

  // A point is there: nothing is given or taken near it from now on.
  void occupy(const Point& point);
  // The same and true, unless it is near one already.
  bool take(const Point& point);

  // Around the points of the cloud from `first` on, whose surfaces are given, one each. A place
  // that was given is not given again.
  std::vector<SurfaceSeed> around(const PointCloud& cloud, std::size_t first,
                                  std::span<const PointSurface> surfaces);

 private:
  struct Taken {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
  };
  using Cells = std::unordered_map<std::uint64_t, std::vector<Taken>>;

  std::uint64_t cellOf(const Eigen::Vector3i& cell) const;
  bool crowded(const Cells& cells, const Taken& place, double distance_mm) const;
  void add(Cells& cells, const Taken& place);

  double spacing_mm_;
  Cells points_;
  Cells given_;
};

}  // namespace gyre
