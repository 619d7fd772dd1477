// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sensor.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"

namespace gyre {
namespace {

constexpr std::size_t kQuantiles = 4096;  // 12 bits: five noise values from one random word
constexpr std::size_t kRowsAtOnce = 48;   // few rows are blurred twice, at the seams

std::vector<float> gaussianKernel(double sigma) {
  const int reach = sigma > 0.05 ? static_cast<int>(std::ceil(3.5 * sigma)) : 0;
  std::vector<float> kernel;
  float sum = 0.0F;
  for (int k = -reach; k <= reach; ++k) {
    kernel.push_back(reach == 0 ? 1.0F
                                : static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    sum += kernel.back();
  }
  for (float& weight : kernel) weight /= sum;
  return kernel;
}

// The value below which a standard Gaussian stays with the probability given.
double gaussianQuantile(double probability) {
  double low = -6.0;
  double high = 6.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<float> noiseQuantiles(double sigma) {
  std::vector<double> values(kQuantiles);
  double variance = 0.0;
  for (std::size_t i = 0; i < kQuantiles; ++i) {
    values[i] = gaussianQuantile((static_cast<double>(i) + 0.5) / kQuantiles);
    variance += values[i] * values[i] / kQuantiles;
  }
  // The table misses the outermost tails: scale what they would have added back.
  const double scale = sigma / std::sqrt(variance);
  std::vector<float> quantiles(kQuantiles);
  for (std::size_t i = 0; i < kQuantiles; ++i) quantiles[i] = static_cast<float>(scale * values[i]);
  return quantiles;
}

// One row blurred along itself; beyond the border the border pixel goes on.
void blurRow(const float* row, int width, const std::vector<float>& kernel, float* blurred) {
  const int reach = static_cast<int>(kernel.size() / 2);
  const int values = 3 * width;
  const auto edge = [&](int i) {
    float sum = 0.0F;
    for (int k = -reach; k <= reach; ++k) {
      const int x = std::clamp(i / 3 + k, 0, width - 1);
      sum += kernel[static_cast<std::size_t>(k + reach)] * row[3 * x + i % 3];
    }
    return sum;
  };
  const int border = std::min(3 * reach, values);
  for (int i = 0; i < border; ++i) blurred[i] = edge(i);
  for (int i = std::max(border, values - border); i < values; ++i) blurred[i] = edge(i);
  if (values <= 2 * border) return;
  std::fill(blurred + border, blurred + values - border, 0.0F);
  for (int k = -reach; k <= reach; ++k) {
    const float weight = kernel[static_cast<std::size_t>(k + reach)];
    for (int i = border; i < values - border; ++i) blurred[i] += weight * row[i + 3 * k];
  }
}

// Adds noise and quantises one row of light, of which 1 is so many grey levels.
void digitise(const std::vector<float>& light, float levels, const std::vector<float>& noise,
              Random random, std::uint8_t* out) {
  std::uint64_t word = 0;
  int left = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (left == 0) {
      word = random.next();
      left = 5;
    }
    const float level = levels * light[i] + noise[word & (kQuantiles - 1)] + 0.5F;
    word >>= 12U;
    --left;
    out[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F));
  }
}

}  // namespace

Sensor::Sensor(double blur_sigma_px, double noise_sigma, double gain)
    : levels_(static_cast<float>(255.0 * gain)),
      kernel_(gaussianKernel(blur_sigma_px)),
      noise_quantile_(noiseQuantiles(noise_sigma)) {}

Frame Sensor::expose(const LightImage& light, std::uint64_t noise_seed) const {
  Frame frame;
  frame.image_bgr.create(light.height_px, light.width_px, CV_8UC3);
  const int reach = static_cast<int>(kernel_.size() / 2);
  const auto values = static_cast<std::size_t>(3 * light.width_px);
  const auto expose_rows = [&](std::size_t begin, std::size_t end) {
    const int first = std::max(static_cast<int>(begin) - reach, 0);
    const int last = std::min(static_cast<int>(end) + reach, light.height_px) - 1;
    std::vector<std::vector<float>> along(static_cast<std::size_t>(last - first + 1));
    for (int y = first; y <= last; ++y) {
      auto& row = along[static_cast<std::size_t>(y - first)];
      row.resize(values);
      blurRow(light.row(y), light.width_px, kernel_, row.data());
    }
    std::vector<float> sum(values);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      std::fill(sum.begin(), sum.end(), 0.0F);
      for (int k = -reach; k <= reach; ++k) {
        const int source = std::clamp(y + k, 0, light.height_px - 1);
        const auto& row = along[static_cast<std::size_t>(source - first)];
        const float weight = kernel_[static_cast<std::size_t>(k + reach)];
        for (std::size_t i = 0; i < values; ++i) sum[i] += weight * row[i];
      }
      digitise(sum, levels_, noise_quantile_,
               Random(hashWords({noise_seed, static_cast<std::uint64_t>(y)})),
               frame.image_bgr.ptr<std::uint8_t>(y));
    }
  };
  parallelFor(static_cast<std::size_t>(light.height_px), kRowsAtOnce, expose_rows);
  return frame;
}

}  // namespace gyre
