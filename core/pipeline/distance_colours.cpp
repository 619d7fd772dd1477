// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/distance_colours.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/base/check.h"

namespace gyre {
namespace {

constexpr Rgb kNoNumber = {128, 128, 128};

std::array<Rgb, 256> viridis() {
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::Mat bgr;
  cv::applyColorMap(ramp, bgr, cv::COLORMAP_VIRIDIS);
  std::array<Rgb, 256> colours{};
  for (int i = 0; i < 256; ++i) {
    const auto& pixel = bgr.at<cv::Vec3b>(0, i);
    colours[static_cast<std::size_t>(i)] = {pixel[2], pixel[1], pixel[0]};
  }
  return colours;
}

}  // namespace

const std::array<Rgb, 256>& distanceColours() {
  static const std::array<Rgb, 256> kColours = viridis();
  return kColours;
}

Rgb distanceColour(double distance_mm, double scale_mm) {
  const double share = distance_mm / scale_mm;
  if (std::isnan(share)) return kNoNumber;
  return distanceColours()[static_cast<std::size_t>(255.0 * std::clamp(share, 0.0, 1.0))];
}

void colourByDistance(Mesh& mesh, std::span<const double> distances_mm, double scale_mm) {
  GYRE_CHECK(distances_mm.size() == mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i].rgb = distanceColour(distances_mm[i], scale_mm);
  }
}

}  // namespace gyre
