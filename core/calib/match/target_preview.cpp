// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_preview.h"

#include <algorithm>
#include <string>
#include <vector>

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

// Every face of the target, with nothing seen of it yet.
std::vector<FaceSight> unseenFaces(const Target& target) {
  std::vector<FaceSight> faces(target.faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    faces[i].points = static_cast<int>(target.faces[i].size());
  }
  return faces;
}

std::string sentenceFor(const TargetSight& sight) {
  if (!sight.passes) {
    return "No face of the target is seen well enough: turn it towards the camera, or bring the "
           "camera nearer.";
  }
  std::size_t seen = 0;
  bool half_hidden = false;
  for (const FaceSight& face : sight.faces) {
    seen += static_cast<std::size_t>(face.seen > 0);
    half_hidden |= face.seen > 0 && !face.passes;
  }
  const std::string points = "Found " + count(sight.found_px.size(), "point", "points");
  if (sight.faces.empty()) return points + ".";
  return points + " on " + count(seen, "face", "faces") +
         (half_hidden ? "; some faces are half hidden." : ".");
}

}  // namespace

TargetSight previewTarget(const cv::Mat& image, const Target& target,
                          const FindTargetOptions& options, const Task& task) {
  TargetSight sight;
  sight.faces = unseenFaces(target);
  const double scale = std::min(1.0, kMostSide_px / std::max({image.cols, image.rows, 1}));
  cv::Mat small = image;
  if (scale < 1.0) cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  FindTargetOptions scaled = options;
  if (scaled.camera) scaled.camera = scaledCamera(*options.camera, scale);
  const auto found = findTarget(small, target, scaled, task);
  if (!found) {
    sight.sentence = found.error().sentence();
    return sight;
  }
  for (const PointSighting& sighting : found->view.sightings) {
    sight.found_px.emplace_back(
        ((sighting.pixel.array() + 0.5) / scale - 0.5).matrix().cast<float>());
  }
  sight.passes = sight.faces.empty();
  for (const FaceFinding& finding : found->faces) {
    if (finding.face < 0) continue;
    FaceSight& face = sight.faces.at(static_cast<std::size_t>(finding.face));
    face = {finding.seen, finding.expected, 2 * finding.seen >= finding.expected};
    sight.passes |= face.passes;
  }
  sight.sentence = sentenceFor(sight);
  return sight;
}

}  // namespace gyre
