// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/target_preview.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

constexpr double kMostSide_px = 800.0;

std::string count(std::size_t number, const std::string& one, const std::string& many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

CameraModel scaledCamera(const CameraModel& camera, double scale) {
  CameraModel scaled = camera;
  scaled.width_px = static_cast<int>(camera.width_px * scale);
  scaled.height_px = static_cast<int>(camera.height_px * scale);
  scaled.fx *= scale;
  scaled.fy *= scale;
  scaled.skew *= scale;
  // Centres of pixels: the picture begins half a pixel before the first one.
  scaled.cx = scale * (camera.cx + 0.5) - 0.5;
  scaled.cy = scale * (camera.cy + 0.5) - 0.5;
  return scaled;
}

}  // namespace

TargetPreview previewTarget(const cv::Mat& image, const Target& target,
                            const FindTargetOptions& options) {
  TargetPreview preview;
  const double scale = std::min(1.0, kMostSide_px / std::max({image.cols, image.rows, 1}));
  cv::Mat small = image;
  if (scale < 1.0) cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  FindTargetOptions scaled = options;
  if (scaled.camera) scaled.camera = scaledCamera(*options.camera, scale);
  const auto found = findTarget(small, target, scaled);
  if (!found) {
    preview.sentence = found.error().sentence();
    return preview;
  }
  for (const PointSighting& sighting : found->view.sightings) {
    preview.points.emplace_back((sighting.pixel.array() + 0.5) / scale - 0.5);
  }
  std::size_t passed = 0;
  for (const FaceFinding& face : found->faces) {
    const bool pass = 2 * face.seen >= face.expected;
    preview.faces.push_back({face.face, face.seen, face.expected, pass});
    passed += static_cast<std::size_t>(pass);
  }
  preview.pass = true;
  preview.sentence = "Found " + count(preview.points.size(), "point", "points") + " on " +
                     count(found->faces.size(), "face", "faces") +
                     (passed < found->faces.size() ? "; some faces are half hidden." : ".");
  return preview;
}

}  // namespace gyre
