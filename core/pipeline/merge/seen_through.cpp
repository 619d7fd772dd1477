// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/seen_through.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace gyre {
namespace {

constexpr std::size_t kOutlinesAsked = 36;
constexpr std::size_t kMostPoints = 4000;
constexpr int kMargin_px = 2;   // of the outlines' own pixels: they err by a few
constexpr double kMany = 0.25;  // of the pictures that show the place

struct WideOutline {
  PosedCamera camera;
  cv::Mat mask;
  double shrunk = 1.0;
};

std::vector<WideOutline> wideOutlines(const PassInput& pass) {
  constexpr int kKernel_px = 2 * kMargin_px + 1;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {kKernel_px, kKernel_px});
  std::vector<WideOutline> wide;
  const std::size_t asked = std::min(kOutlinesAsked, pass.silhouettes.size());
  for (std::size_t i = 0; i < asked; ++i) {
    const Silhouette& silhouette = pass.silhouettes[i * pass.silhouettes.size() / asked];
    if (silhouette.view >= pass.views.size()) continue;
    WideOutline outline;
    outline.camera = pass.views[silhouette.view].camera;
    cv::dilate(silhouette.mask, outline.mask, disc);
    outline.shrunk = shrinkOf(outline.mask, outline.camera.intrinsics.width_px);
    wide.push_back(std::move(outline));
  }
  return wide;
}

bool isSeenThrough(const Eigen::Vector3d& place, const std::vector<WideOutline>& outlines) {
  int shown = 0;
  int outside = 0;
  for (const WideOutline& outline : outlines) {
    const auto pixel = outline.camera.intrinsics.project(outline.camera.cam_from_table * place);
    if (!pixel || !outline.camera.intrinsics.contains(*pixel)) continue;
    const int x =
        std::min(static_cast<int>((pixel->x() + 0.5) / outline.shrunk), outline.mask.cols - 1);
    const int y =
        std::min(static_cast<int>((pixel->y() + 0.5) / outline.shrunk), outline.mask.rows - 1);
    ++shown;
    if (outline.mask.at<std::uint8_t>(y, x) == 0) ++outside;
  }
  return outside > kMany * shown;
}

}  // namespace

double seenThroughShare(const PointCloud& cloud, const Rigid3& other_from_cloud,
                        const PassInput& other) {
  const std::vector<WideOutline> outlines = wideOutlines(other);
  if (outlines.empty() || cloud.points.empty()) return 0.0;
  const std::size_t stride = (cloud.points.size() + kMostPoints - 1) / kMostPoints;
  std::size_t asked = 0;
  std::size_t through = 0;
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    ++asked;
    if (isSeenThrough(other_from_cloud * cloud.points[i].position, outlines)) ++through;
  }
  return static_cast<double>(through) / static_cast<double>(asked);
}

}  // namespace gyre
