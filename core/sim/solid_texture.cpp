// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/solid_texture.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/base/random.h"

namespace gyre {
namespace {

constexpr int kSide = 32;  // cells of the tile; a power of two
constexpr int kMask = kSide - 1;
constexpr std::size_t kCells = std::size_t{kSide} * kSide * kSide;
// The tile is white noise blurred by 0.8 cells less the same blurred by 1.6: its spectrum peaks at
// 2 pi / sqrt(2 ln(4) / (1.6^2 - 0.8^2)) = 5.2 cells a wave.
constexpr double kNarrow = 0.8;
constexpr double kWide = 1.6;
constexpr double kCellsPerWave = 5.2;

std::size_t cellIndex(int x, int y, int z) {
  return static_cast<std::size_t>(((z & kMask) * kSide + (y & kMask)) * kSide + (x & kMask));
}

using Tile = std::vector<Eigen::Array4f>;

// Gaussian blur along one axis, periodic.
Tile blurredAlong(const Tile& tile, int axis, double sigma) {
  constexpr int kReach = 6;
  Tile result(kCells);
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        Eigen::Array4f sum = Eigen::Array4f::Zero();
        for (int k = -kReach; k <= kReach; ++k) {
          const auto weight = static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma)));
          sum += weight * tile[cellIndex(x + (axis == 0 ? k : 0), y + (axis == 1 ? k : 0),
                                         z + (axis == 2 ? k : 0))];
        }
        result[cellIndex(x, y, z)] = sum / static_cast<float>(sigma * std::sqrt(2.0 * M_PI));
      }
    }
  }
  return result;
}

Tile blurred(const Tile& tile, double sigma) {
  return blurredAlong(blurredAlong(blurredAlong(tile, 0, sigma), 1, sigma), 2, sigma);
}

}  // namespace

SolidTexture::SolidTexture(std::uint64_t seed, double finest_mm, double coarsest_mm) {
  GYRE_CHECK(finest_mm > 0.0 && coarsest_mm >= finest_mm);
  Random random(seed);
  Tile white(kCells);
  for (Eigen::Array4f& cell : white) {
    for (int channel = 0; channel < 4; ++channel) {
      cell[channel] = static_cast<float>(random.gaussian());
    }
  }
  tile_ = blurred(white, kNarrow);
  const Tile wide = blurred(white, kWide);
  for (std::size_t i = 0; i < kCells; ++i) tile_[i] -= wide[i];

  double wave_mm = finest_mm;
  while (wave_mm <= coarsest_mm * 1.0001) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(random.gaussian(), random.gaussian(),
                                                       random.gaussian(), random.gaussian())
                                        .normalized();
    const double cells_per_mm = kCellsPerWave / wave_mm;
    Octave octave;
    octave.cells_from_mm = (cells_per_mm * turn.toRotationMatrix()).cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      octave.shift[axis] = static_cast<float>(8192.0 + random.uniform(0.0, kSide));
    }
    octaves_.push_back(octave);
    wave_mm *= 2.0;
  }

  // Interpolation takes some of the variance away: measure what is left instead of assuming it.
  double variance = 0.0;
  constexpr int kProbes = 20000;
  for (int i = 0; i < kProbes; ++i) {
    const Eigen::Vector3f cells(static_cast<float>(random.uniform(0.0, kSide)),
                                static_cast<float>(random.uniform(0.0, kSide)),
                                static_cast<float>(random.uniform(0.0, kSide)));
    variance += static_cast<double>(interpolate(cells).square().mean()) / kProbes;
  }
  scale_ = static_cast<float>(1.0 / std::sqrt(variance * static_cast<double>(octaves_.size())));
}

Eigen::Array4f SolidTexture::interpolate(const Eigen::Vector3f& cells) const {
  const auto x = static_cast<int>(cells.x());  // positive: truncation is the floor
  const auto y = static_cast<int>(cells.y());
  const auto z = static_cast<int>(cells.z());
  const float fx = cells.x() - static_cast<float>(x);
  const float fy = cells.y() - static_cast<float>(y);
  const float fz = cells.z() - static_cast<float>(z);
  const auto row = [&](int dy, int dz) -> Eigen::Array4f {
    const Eigen::Array4f& a = tile_[cellIndex(x, y + dy, z + dz)];
    const Eigen::Array4f& b = tile_[cellIndex(x + 1, y + dy, z + dz)];
    return a + fx * (b - a);
  };
  const Eigen::Array4f r00 = row(0, 0);
  const Eigen::Array4f r10 = row(1, 0);
  const Eigen::Array4f r01 = row(0, 1);
  const Eigen::Array4f r11 = row(1, 1);
  const Eigen::Array4f near = r00 + fy * (r10 - r00);
  const Eigen::Array4f far = r01 + fy * (r11 - r01);
  return near + fz * (far - near);
}

Eigen::Array4f SolidTexture::at(const Eigen::Vector3f& point_mm) const {
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (const Octave& octave : octaves_) {
    const Eigen::Vector3f cells = octave.cells_from_mm * point_mm + octave.shift;
    sum += interpolate(cells.cwiseMax(0.0F));
  }
  return scale_ * sum;
}

}  // namespace gyre
