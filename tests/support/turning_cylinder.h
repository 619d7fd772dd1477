// A world whose truth is a formula: a textured cylinder on a textured platter that turns before a
// still, textured wall, seen by an exact pinhole camera.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/scan/calibration.h"
#include "core/scan/frame.h"

namespace gyre::test {

struct TurningCylinder {
  double radius_mm = 30.0;
  double height_mm = 50.0;
  double platter_radius_mm = 55.0;
  double noise_sigma = 1.0;  // grey levels
  double contrast = 1.0;     // of the cylinder's texture; 0 is plain
  std::uint64_t seed = 1;

  // 400x300 pixels, looking down 25 degrees, the cylinder about 190 pixels wide.
  Calibration calibration() const;

  // The picture at a table angle. name and view are left empty.
  Frame render(double table_angle_rad) const;
  Frame renderEmpty(double table_angle_rad = 0.0) const;

  // Distance of a point in the table frame from the cylinder's side or lid. [mm]
  double distanceToSurface(const Eigen::Vector3d& point_in_table) const;
};

// A band-limited pattern over the plane, mean 0, about -1 to 1: nothing finer than one unit.
double pattern(double x, double y, std::uint64_t seed);

}  // namespace gyre::test
