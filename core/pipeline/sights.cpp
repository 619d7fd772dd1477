// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/sights.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/io/file_bytes.h"
#include "core/io/silhouettes_file.h"

namespace gyre {

namespace {

// So many views, spread over the turn, tell where the background is seen: a wrong outline in one
// does no harm, and more of them tell little that is new.
constexpr std::size_t kOutlinesAsked = 72;
constexpr int kCoarser = 2;      // than the outlines kept: so many rays are enough
constexpr int kWidening_px = 1;  // around each point, and of the whole: masks err by a few pixels
constexpr int kMargin_px = 3;    // around the outline's box: rays farther out meet nothing anyhow

// Where the points of the cloud are seen, or would be.
std::vector<Eigen::Vector2d> pixelsOf(const PointCloud& cloud, const PosedCamera& camera) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(cloud.points.size());
  for (const Point& point : cloud.points) {
    if (const auto pixel = camera.intrinsics.project(camera.cam_from_table * point.position)) {
      pixels.push_back(*pixel);
    }
  }
  return pixels;
}

// Makes the mask full of the object at each of the picture's pixels, and so far around it.
void fillAt(const std::vector<Eigen::Vector2d>& pixels, double shrunk, int around_px,
            cv::Mat& mask) {
  for (const Eigen::Vector2d& pixel : pixels) {
    const int x = static_cast<int>(std::floor((pixel.x() + 0.5) / shrunk));
    const int y = static_cast<int>(std::floor((pixel.y() + 0.5) / shrunk));
    for (int row = std::max(0, y - around_px); row <= std::min(mask.rows - 1, y + around_px);
         ++row) {
      for (int column = std::max(0, x - around_px);
           column <= std::min(mask.cols - 1, x + around_px); ++column) {
        mask.at<std::uint8_t>(row, column) = 255;
      }
    }
  }
}

// Coarser and wider than the outline, and full of the object where points of the cloud are seen,
// beside it too: what is 0 is background for certain.
cv::Mat widened(const cv::Mat& outline, int picture_width_px,
                const std::vector<Eigen::Vector2d>& pixels) {
  cv::Mat mask;
  cv::resize(outline, mask, {outline.cols / kCoarser, outline.rows / kCoarser}, 0.0, 0.0,
             cv::INTER_AREA);
  constexpr int kKernel_px = 2 * kWidening_px + 1;
  cv::dilate(mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {kKernel_px, kKernel_px}));
  fillAt(pixels, shrinkOf(mask, picture_width_px), kWidening_px, mask);
  return mask;
}

// The pixels of the object, as a box.
cv::Rect boxOf(const cv::Mat& mask) {
  cv::Rect box;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) != 0) box |= cv::Rect(x, y, 1, 1);
    }
  }
  return box;
}

std::vector<Ray> backgroundOf(const cv::Mat& mask, const PosedCamera& camera) {
  std::vector<Ray> rays;
  const double shrunk = shrinkOf(mask, camera.intrinsics.width_px);
  const cv::Rect object = boxOf(mask);
  if (object.empty()) return rays;
  const cv::Rect box = cv::Rect(object.x - kMargin_px, object.y - kMargin_px,
                                object.width + 2 * kMargin_px, object.height + 2 * kMargin_px) &
                       cv::Rect(0, 0, mask.cols, mask.rows);
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      if (mask.at<std::uint8_t>(y, x) != 0) continue;
      const Eigen::Vector2d pixel((x + 0.5) * shrunk - 0.5, (y + 0.5) * shrunk - 0.5);
      rays.push_back(
          rayThrough(camera.cam_from_table, camera.intrinsics.normalizedFromPixel(pixel)));
    }
  }
  return rays;
}

}  // namespace

SightEvidence sightsOf(const ResultViews& views, const Silhouettes& silhouettes,
                       const PointCloud& cloud) {
  SightEvidence sights;
  for (const ResultView& view : views) {
    sights.camera_centres.push_back(view.camera.centreInTable());
  }
  const std::size_t passes = views.empty() ? 1 : views.back().pass + 1;
  const std::size_t asked = std::min(passes * kOutlinesAsked, silhouettes.size());
  std::vector<const Silhouette*> chosen;
  for (std::size_t i = 0; i < asked; ++i) {
    const Silhouette& silhouette = silhouettes[i * silhouettes.size() / asked];
    if (silhouette.view < views.size()) chosen.push_back(&silhouette);
  }
  sights.background.resize(chosen.size());
  sights.outlines.resize(chosen.size());
  parallelFor(chosen.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PosedCamera& camera = views[chosen[i]->view].camera;
      const int width_px = camera.intrinsics.width_px;
      const std::vector<Eigen::Vector2d> pixels = pixelsOf(cloud, camera);
      cv::Mat outline = chosen[i]->mask.clone();
      sights.background[i] = backgroundOf(widened(outline, width_px, pixels), camera);
      fillAt(pixels, shrinkOf(outline, width_px), 0, outline);
      sights.outlines[i] = {camera, outline};
    }
  });
  return sights;
}

Result<std::optional<SightEvidence>> readSights(const std::filesystem::path& folder,
                                                const PointCloud& cloud) {
  if (!hasResultViews(folder)) return std::optional<SightEvidence>();
  const auto views = readResultViews(folder);
  if (!views) return views.error();
  Silhouettes silhouettes;
  if (const auto file = folder / "silhouettes.bin"; isThere(file)) {
    auto read = readSilhouettes(file);
    if (!read) return read.error();
    silhouettes = std::move(*read);
  }
  return std::optional(sightsOf(*views, silhouettes, cloud));
}

}  // namespace gyre
