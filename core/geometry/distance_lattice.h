// Samples of a signed distance on a regular lattice, taken only where the surface may be.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/task.h"

namespace gyre {

// Of a place in mm: negative inside, positive outside, with a slope of about 1 at the surface.
using SignedDistance = std::function<double(const Eigen::Vector3d&)>;

// Away from the surface the value may exceed the true distance to it by these factors at most.
struct DistanceStretch {
  double outside = 1.0;
  double inside = 1.0;
};

struct DistanceLattice {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of point (0, 0, 0), mm
  double cell_mm = 1.0;                              // from point to point
  Eigen::Array3i size = Eigen::Array3i::Zero();      // points along each axis
  // Of every point, x fastest. Farther from the surface than a few cells only the sign is right.
  std::vector<float> values;

  std::size_t index(const Eigen::Array3i& p) const {
    return static_cast<std::size_t>(p.x()) +
           static_cast<std::size_t>(size.x()) *
               (static_cast<std::size_t>(p.y()) +
                static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(p.z()));
  }
  Eigen::Vector3d at(const Eigen::Array3i& p) const {
    return origin + cell_mm * p.cast<double>().matrix();
  }
  float value(const Eigen::Array3i& p) const { return values[index(p)]; }
  bool inside(const Eigen::Array3i& p) const { return value(p) < 0.0F; }
};

// The lattice reaches beyond the box by at least one cell on each side. The function is called from
// several threads; the result does not depend on their number. When stopped it returns at once,
// with values that mean nothing.
DistanceLattice sampleDistance(const SignedDistance& distance, const Eigen::AlignedBox3d& box,
                               double cell_mm, const DistanceStretch& stretch = {},
                               const Task& task = {});

}  // namespace gyre
