// From light on the sensor to the picture a camera gives: blur, noise, eight bits.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan/frame.h"

namespace gyre {

// Light per pixel, 1 = full scale; row by row, blue, green, red.
struct LightImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> bgr;

  LightImage(int width, int height)
      : width_px(width),
        height_px(height),
        bgr(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  float* row(int y) { return bgr.data() + 3 * static_cast<std::size_t>(y) * pitch(); }
  const float* row(int y) const { return bgr.data() + 3 * static_cast<std::size_t>(y) * pitch(); }

 private:
  std::size_t pitch() const { return static_cast<std::size_t>(width_px); }
};

// Immutable: any thread may expose.
class Sensor {
 public:
  // blur_sigma_px: Gaussian blur of the lens. noise_sigma: grey levels of 255 a channel. gain: what
  // light is multiplied by before it is cut off at full scale.
  Sensor(double blur_sigma_px, double noise_sigma, double gain = 1.0);

  // The picture, 8 bit BGR. The noise is a function of noise_seed and the pixel alone.
  Frame expose(const LightImage& light, std::uint64_t noise_seed) const;

 private:
  float levels_;                       // grey levels of light 1
  std::vector<float> kernel_;          // odd length, sums to 1
  std::vector<float> noise_quantile_;  // equally likely noise values, grey levels
};

}  // namespace gyre
