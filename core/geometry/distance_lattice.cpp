// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/distance_lattice.h"

#include <cmath>
#include <cstdint>

#include "core/base/check.h"
#include "core/base/parallel.h"

namespace gyre {
namespace {

constexpr int kSide = 8;  // of a block, in lattice points

// Fills one block; far from the surface one evaluation stands for all its points.
void sampleBlock(const SignedDistance& distance, const DistanceStretch& stretch,
                 const Eigen::Array3i& from, DistanceLattice& lattice) {
  const Eigen::Array3i to = (from + kSide).min(lattice.size);
  const Eigen::Vector3d centre =
      lattice.at(from) + Eigen::Vector3d::Constant(0.5 * (kSide - 1) * lattice.cell_mm);
  const double reach_mm = std::sqrt(3.0) * 0.5 * (kSide + 1) * lattice.cell_mm;
  const double there = distance(centre);
  const bool far = there > stretch.outside * reach_mm || there < -stretch.inside * reach_mm;
  for (int z = from.z(); z < to.z(); ++z) {
    for (int y = from.y(); y < to.y(); ++y) {
      for (int x = from.x(); x < to.x(); ++x) {
        const Eigen::Array3i p(x, y, z);
        lattice.values[lattice.index(p)] =
            static_cast<float>(far ? there : distance(lattice.at(p)));
      }
    }
  }
}

}  // namespace

DistanceLattice sampleDistance(const SignedDistance& distance, const Eigen::AlignedBox3d& box,
                               double cell_mm, const DistanceStretch& stretch, const Task& task) {
  GYRE_CHECK(cell_mm > 0.0 && !box.isEmpty());
  DistanceLattice lattice;
  lattice.cell_mm = cell_mm;
  // The odd shift keeps lattice points off planes of symmetry and off the base.
  lattice.origin = box.min() - Eigen::Vector3d::Constant(2.37 * cell_mm);
  lattice.size = ((box.max() - lattice.origin) / cell_mm).array().ceil().cast<int>() + 3;
  lattice.values.resize(static_cast<std::size_t>(lattice.size.cast<std::int64_t>().prod()));
  const Eigen::Array3i blocks = (lattice.size + kSide - 1) / kSide;
  parallelFor(static_cast<std::size_t>(blocks.z()), 1, [&](std::size_t begin, std::size_t end) {
    for (int z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
      for (int y = 0; y < blocks.y(); ++y) {
        for (int x = 0; x < blocks.x() && !task.stopRequested(); ++x) {
          sampleBlock(distance, stretch, kSide * Eigen::Array3i(x, y, z), lattice);
        }
      }
    }
  });
  return lattice;
}

}  // namespace gyre
