// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/corners/picture_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr int kRowStep = 3;             // a third of the rows tells as much, three times as fast
constexpr double kMaskGain = 6.0;       // root of the sum of the mask's squares
constexpr double kMedianGain = 0.6745;  // median of |x| for a normal x of standard deviation 1

}  // namespace

double pictureNoise(const cv::Mat& grey) {
  GYRE_CHECK(grey.empty() || grey.type() == CV_8U);
  // The mask [1 -2 1]^T [1 -2 1] answers whole numbers from -8 * 255 to 8 * 255.
  std::array<std::int64_t, 8 * 255 + 1> counts{};
  std::int64_t total = 0;
  for (int row = 1; row + 1 < grey.rows; row += kRowStep) {
    const std::uint8_t* above = grey.ptr(row - 1);
    const std::uint8_t* here = grey.ptr(row);
    const std::uint8_t* below = grey.ptr(row + 1);
    const auto bend = [&](int column) { return above[column] - 2 * here[column] + below[column]; };
    for (int column = 1; column + 1 < grey.cols; ++column) {
      const int answer = bend(column - 1) - 2 * bend(column) + bend(column + 1);
      ++counts[static_cast<std::size_t>(std::abs(answer))];
      ++total;
    }
  }
  const double rounding = std::sqrt(1.0 / 12.0);
  std::int64_t below = 0;
  for (std::size_t answer = 0; answer < counts.size(); ++answer) {
    if (2 * (below + counts[answer]) < total || counts[answer] == 0) {
      below += counts[answer];
      continue;
    }
    // An answer of n stands for all from n - 1/2 to n + 1/2, those below zero mirrored.
    const double part = (0.5 * static_cast<double>(total) - static_cast<double>(below)) /
                        static_cast<double>(counts[answer]);
    const double median = answer == 0 ? 0.5 * part : static_cast<double>(answer) - 0.5 + part;
    return std::max(rounding, median / (kMedianGain * kMaskGain));
  }
  return rounding;
}

}  // namespace gyre
