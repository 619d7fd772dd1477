// How alike two patches are, whatever their brightness and contrast.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "core/scan/frame.h"

namespace gyre {

inline constexpr int kPatchRadius_px = 5;
inline constexpr int kPatchSide_px = 2 * kPatchRadius_px + 1;

// A square of grey values with mean 0 and length 1.
using NormalizedPatch = std::array<float, std::size_t{kPatchSide_px} * kPatchSide_px>;

// The patch around a pixel, bilinearly sampled; nothing when it leaves the picture or is flat.
std::optional<NormalizedPatch> samplePatch(const cv::Mat& grey, const Eigen::Vector2d& pixel);

// Normalised cross-correlation in [-1, 1].
float correlate(const NormalizedPatch& a, const NormalizedPatch& b);

// The same against the patch around a whole pixel, without sampling it first; -1 when that leaves
// the picture or is flat.
float correlateAt(const NormalizedPatch& patch, const cv::Mat& grey, int column, int row);

}  // namespace gyre
