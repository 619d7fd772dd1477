// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/correlation.h"

#include <cmath>

namespace gyre {
namespace {

constexpr int kArea = kPatchSide_px * kPatchSide_px;
// Length of a centred patch below which it holds nothing but noise.
constexpr float kFlat = 1.0F;

bool inside(const cv::Mat& grey, int column, int row, int reach) {
  return column >= reach && row >= reach && column + reach < grey.cols && row + reach < grey.rows;
}

}  // namespace

std::optional<NormalizedPatch> samplePatch(const cv::Mat& grey, const Eigen::Vector2d& pixel) {
  const int column = static_cast<int>(std::floor(pixel.x()));
  const int row = static_cast<int>(std::floor(pixel.y()));
  if (!inside(grey, column, row, kPatchRadius_px + 1)) return std::nullopt;
  const auto fx = static_cast<float>(pixel.x() - column);
  const auto fy = static_cast<float>(pixel.y() - row);
  NormalizedPatch patch;
  float sum = 0.0F;
  float* out = patch.data();
  for (int y = row - kPatchRadius_px; y <= row + kPatchRadius_px; ++y) {
    const std::uint8_t* top = grey.ptr<std::uint8_t>(y) + column - kPatchRadius_px;
    const std::uint8_t* bottom = grey.ptr<std::uint8_t>(y + 1) + column - kPatchRadius_px;
    for (int i = 0; i < kPatchSide_px; ++i) {
      const float upper = static_cast<float>(top[i]) + fx * static_cast<float>(top[i + 1] - top[i]);
      const float lower =
          static_cast<float>(bottom[i]) + fx * static_cast<float>(bottom[i + 1] - bottom[i]);
      *out = upper + fy * (lower - upper);
      sum += *out++;
    }
  }
  const float mean = sum / kArea;
  float squares = 0.0F;
  for (float& value : patch) {
    value -= mean;
    squares += value * value;
  }
  const float length = std::sqrt(squares);
  if (length < kFlat) return std::nullopt;
  for (float& value : patch) value /= length;
  return patch;
}

float correlate(const NormalizedPatch& a, const NormalizedPatch& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

float correlateAt(const NormalizedPatch& patch, const cv::Mat& grey, int column, int row) {
  if (!inside(grey, column, row, kPatchRadius_px)) return -1.0F;
  float dot = 0.0F;
  int sum = 0;
  int squares = 0;
  const float* expected = patch.data();
  for (int y = row - kPatchRadius_px; y <= row + kPatchRadius_px; ++y) {
    const std::uint8_t* line = grey.ptr<std::uint8_t>(y) + column - kPatchRadius_px;
    for (int i = 0; i < kPatchSide_px; ++i) {
      const int value = line[i];
      dot += static_cast<float>(value) * expected[i];
      sum += value;
      squares += value * value;
    }
    expected += kPatchSide_px;
  }
  // The patch has mean 0, so the mean of the picture's values drops out of the product.
  const float variance =
      static_cast<float>(squares) - static_cast<float>(sum) * static_cast<float>(sum) / kArea;
  if (variance < kFlat * kFlat) return -1.0F;
  return dot / std::sqrt(variance);
}

}  // namespace gyre
