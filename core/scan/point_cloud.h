// Measured points on the object's surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace gyre {

using Rgb = std::array<std::uint8_t, 3>;

// One surface point, in the table frame.
struct Point {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // unit, outward; zero when unknown
  Rgb rgb{};
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // mm^2
  std::vector<std::uint32_t> views;                      // indices of the views that saw it

  // Square root of the covariance's trace. [mm]
  double sigmaMm() const;
};

struct PointCloud {
  std::vector<Point> points;
};
using PointCloudPtr = std::shared_ptr<const PointCloud>;

// Smallest and largest coordinates; min > max when there are no points. [mm]
struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);

  void include(const Eigen::Vector3d& position);
  bool empty() const { return min.x() > max.x(); }
  double diagonal() const { return empty() ? 0.0 : (max - min).norm(); }
};
Bounds boundsOf(const PointCloud& cloud);

}  // namespace gyre
