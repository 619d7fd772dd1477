// Texture that fills space: band-limited noise, so that no picture of it is aliased.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gyre {

// Four independent noise values at every point, each a sum of octaves of equal strength. Immutable:
// any thread may ask.
class SolidTexture {
 public:
  // Octaves with wavelengths finest_mm, 2 finest_mm, ... up to coarsest_mm at most.
  SolidTexture(std::uint64_t seed, double finest_mm, double coarsest_mm);

  // Mean 0, standard deviation 1 each.
  Eigen::Array4f at(const Eigen::Vector3f& point_mm) const;

 private:
  struct Octave {
    Eigen::Matrix3f cells_from_mm;  // turned at random, so that the lattices do not line up
    Eigen::Vector3f shift;          // cells; large enough that all coordinates are positive
  };

  Eigen::Array4f interpolate(const Eigen::Vector3f& cells) const;

  std::vector<Octave> octaves_;
  std::vector<Eigen::Array4f> tile_;  // one periodic block of band-passed noise
  float scale_ = 1.0F;
};

}  // namespace gyre
