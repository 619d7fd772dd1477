// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/cloud_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr int kShrink = 4;
constexpr int kOutlineWidth_px = 640;  // a kept outline is at most so wide, and halved at least
constexpr std::size_t kGrain = 256;
// Neighbours are looked for within this share of the cloud's size.
constexpr double kNeighbourhood = 0.025;

using Cell = std::array<int, 3>;

Cell cellOf(const Eigen::Vector3d& position, double side_mm) {
  const auto index = [&](double value) { return static_cast<int>(std::floor(value / side_mm)); };
  return {index(position.x()), index(position.y()), index(position.z())};
}

// The size of the cloud without its farthest specks: the diagonal of the box that holds the middle
// 98 % of every coordinate.
double robustSize(const PointCloud& cloud) {
  Eigen::Vector3d extent;
  std::vector<double> values(cloud.points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = cloud.points[i].position[axis];
    std::sort(values.begin(), values.end());
    const std::size_t tail = values.size() / 100;
    extent[axis] = values[values.size() - 1 - tail] - values[tail];
  }
  return extent.norm();
}

// Drops points that have too few others near them.
void dropSpecks(const PointCloud& cloud, double reach_mm, int min_neighbours,
                std::vector<std::uint8_t>& keep) {
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) cells[cellOf(cloud.points[i].position, reach_mm)].push_back(i);
  }
  const std::vector<std::uint8_t> before = keep;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (before[i] == 0) continue;
    const Eigen::Vector3d& position = cloud.points[i].position;
    const Cell centre = cellOf(position, reach_mm);
    int neighbours = -1;  // the point finds itself
    for (int k = 0; k < 27 && neighbours < min_neighbours; ++k) {
      const auto cell =
          cells.find({centre[0] + k % 3 - 1, centre[1] + k / 3 % 3 - 1, centre[2] + k / 9 - 1});
      if (cell == cells.end()) continue;
      for (const std::size_t other : cell->second) {
        const double apart = (cloud.points[other].position - position).squaredNorm();
        if (apart <= reach_mm * reach_mm && ++neighbours >= min_neighbours) break;
      }
    }
    if (neighbours < min_neighbours) keep[i] = 0;
  }
}

// A pixel is 255 where any of the pixels in it is not 0.
cv::Mat shrunkToAny(const cv::Mat& mask) {
  const int shrink = std::max(2, (mask.cols + kOutlineWidth_px - 1) / kOutlineWidth_px);
  const cv::Size size(mask.cols / shrink, mask.rows / shrink);
  cv::Mat small;
  cv::resize(mask(cv::Rect({}, size * shrink)), small, size, 0, 0, cv::INTER_AREA);
  return small != 0;
}

}  // namespace

void SilhouetteRecord::addView(const cv::Mat& mask, double table_angle_rad) {
  const std::size_t added = added_++;
  if (cv::countNonZero(mask) == mask.rows * mask.cols) return;
  View view;
  view.added = added;
  view.cam_from_table = camFromTable(*calibration_.cam_from_table, table_angle_rad);
  // Grown by a few pixels: masks are not exact to the pixel, and points sit on the outline.
  cv::Mat small;
  cv::resize(mask, small, {mask.cols / kShrink, mask.rows / kShrink}, 0, 0, cv::INTER_AREA);
  cv::dilate(small, view.grown, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  view.as_it_is = shrunkToAny(mask);
  views_.push_back(std::move(view));
}

SilhouetteRecord SilhouetteRecord::turned(std::span<const double> corrections_rad) const {
  GYRE_CHECK(corrections_rad.size() == added_);
  SilhouetteRecord record = *this;
  for (View& view : record.views_) {
    view.cam_from_table = camFromTable(view.cam_from_table, corrections_rad[view.added]);
  }
  return record;
}

Silhouettes SilhouetteRecord::silhouettes() const {
  Silhouettes silhouettes;
  silhouettes.reserve(views_.size());
  for (const View& view : views_) {
    silhouettes.push_back({static_cast<std::uint32_t>(view.added), view.as_it_is});
  }
  return silhouettes;
}

double SilhouetteRecord::outsideShare(const Eigen::Vector3d& point_in_table,
                                      std::size_t most_views) const {
  const std::size_t stride = (views_.size() + most_views - 1) / most_views;
  int inside_picture = 0;
  int outside = 0;
  for (std::size_t i = 0; i < views_.size(); i += stride) {
    const View& view = views_[i];
    const auto pixel = calibration_.camera.project(view.cam_from_table * point_in_table);
    if (!pixel || !calibration_.camera.contains(*pixel)) continue;
    const int column = std::min(static_cast<int>(pixel->x()) / kShrink, view.grown.cols - 1);
    const int row = std::min(static_cast<int>(pixel->y()) / kShrink, view.grown.rows - 1);
    ++inside_picture;
    if (view.grown.at<std::uint8_t>(row, column) == 0) ++outside;
  }
  return inside_picture == 0 ? 0.0 : static_cast<double>(outside) / inside_picture;
}

std::vector<std::uint8_t> judgePoints(const PointCloud& cloud, const SilhouetteRecord& silhouettes,
                                      const CloudOptions& options, Scrutiny scrutiny) {
  std::vector<std::uint8_t> keep(cloud.points.size(), 1);
  if (keep.empty()) return keep;
  const double size_mm = robustSize(cloud);
  parallelFor(keep.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& point = cloud.points[i];
      if (point.sigmaMm() > options.max_sigma_share * size_mm ||
          silhouettes.outsideShare(point.position, static_cast<std::size_t>(scrutiny)) >
              options.max_outside) {
        keep[i] = 0;
      }
    }
  });
  dropSpecks(cloud, kNeighbourhood * size_mm, options.min_neighbours, keep);
  return keep;
}

}  // namespace gyre
