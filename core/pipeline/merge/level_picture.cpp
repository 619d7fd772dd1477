// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/level_picture.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/mesh/depth_map.h"

namespace gyre {
namespace {

constexpr double kSteepest_deg = 65.0;
constexpr int kAcross_px = 3;           // between the places that tell the surface's slant
constexpr int kRim_px = 3;              // so near to the outline the depth is another thing's
constexpr double kHiddenShare = 0.004;  // of the distance: what lies so far behind is hidden
constexpr double kLeastLevel = 0.2;     // of the camera's way to the object
constexpr double kMargin = 1.05;

Mesh seenPart(const Mesh& mesh) {
  Mesh part;
  part.vertices = mesh.vertices;
  for (const Triangle& triangle : mesh.triangles) {
    const bool seen = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      return mesh.vertices[vertex].seen != 0;
    });
    if (seen) part.triangles.push_back(triangle);
  }
  return part;
}

// At the same distance and side, looking at the middle of the box; as fine as the camera's picture,
// and as large as the box asks.
std::optional<PosedCamera> levelCamera(const PosedCamera& from, const Bounds& bounds) {
  const Eigen::Vector3d middle = 0.5 * (bounds.min + bounds.max);
  const Eigen::Vector3d way = from.centreInTable() - middle;
  const double level_mm = way.head<2>().norm();
  if (level_mm < kLeastLevel * way.norm()) return std::nullopt;
  const Eigen::Vector3d outward(way.x() / level_mm, way.y() / level_mm, 0.0);
  PosedCamera level;
  CameraModel& camera = level.intrinsics;
  camera.fx = camera.fy = 0.5 * (from.intrinsics.fx + from.intrinsics.fy);
  const double radius_mm = 0.5 * bounds.diagonal();
  const double half_px = kMargin * camera.fx * radius_mm / std::max(way.norm() - radius_mm, 1e-9);
  camera.width_px = camera.height_px =
      std::clamp(static_cast<int>(2.0 * half_px), 16, from.intrinsics.width_px);
  camera.cx = camera.cy = 0.5 * (camera.width_px - 1);
  Eigen::Matrix3d& rotation = level.cam_from_table.rotation;
  rotation.row(0) = Eigen::Vector3d(-outward.y(), outward.x(), 0.0);
  rotation.row(1) = -Eigen::Vector3d::UnitZ();
  rotation.row(2) = -outward;
  level.cam_from_table.translation = -(rotation * (middle + way.norm() * outward));
  return level;
}

// Between pixels; nothing at the picture's edge.
std::optional<double> brightnessAt(const cv::Mat& grey, const Eigen::Vector2d& pixel) {
  const auto x = static_cast<int>(std::floor(pixel.x()));
  const auto y = static_cast<int>(std::floor(pixel.y()));
  if (x < 0 || y < 0 || x + 1 >= grey.cols || y + 1 >= grey.rows) return std::nullopt;
  const double right = pixel.x() - x;
  const double down = pixel.y() - y;
  const auto* upper = grey.ptr<std::uint8_t>(y) + x;
  const auto* lower = grey.ptr<std::uint8_t>(y + 1) + x;
  return (1.0 - down) * ((1.0 - right) * upper[0] + right * upper[1]) +
         down * ((1.0 - right) * lower[0] + right * lower[1]);
}

}  // namespace

LevelPicture::LevelPicture(const Mesh& mesh, const PosedCamera& camera, const cv::Mat& grey) {
  if (mesh.triangles.empty()) return;
  const auto level = levelCamera(camera, boundsOf(mesh));
  if (!level) return;
  camera_ = *level;
  depth_ = depthMap(seenPart(mesh), camera_, 1);
  depth_.setTo(0.0F, (depthMap(mesh, camera_, 1) < depth_) | (depth_ > 1e9F));
  draw(mesh, camera, grey);
  constexpr int kKernel_px = 2 * kRim_px + 1;
  cv::erode(mask_, mask_, cv::getStructuringElement(cv::MORPH_RECT, {kKernel_px, kKernel_px}));
}

void LevelPicture::draw(const Mesh& mesh, const PosedCamera& from, const cv::Mat& grey) {
  const cv::Mat nearest_mm = depthMap(mesh, from, 1);
  grey_ = cv::Mat::zeros(depth_.size(), CV_8U);
  mask_ = cv::Mat::zeros(depth_.size(), CV_8U);
  parallelFor(static_cast<std::size_t>(depth_.rows), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < depth_.cols; ++x) {
        const auto place = placeAt({static_cast<double>(x), static_cast<double>(y)});
        if (!place) continue;
        const Eigen::Vector3d in_cam = from.cam_from_table * *place;
        const auto pixel = from.intrinsics.project(in_cam);
        if (!pixel) continue;
        const auto brightness = brightnessAt(grey, *pixel);
        if (!brightness) continue;
        const auto first_mm = static_cast<double>(nearest_mm.at<float>(
            static_cast<int>(std::lround(pixel->y())), static_cast<int>(std::lround(pixel->x()))));
        if (first_mm < (1.0 - kHiddenShare) * in_cam.z()) continue;
        grey_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::lround(*brightness));
        mask_.at<std::uint8_t>(y, x) = 255;
      }
    }
  });
}

std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> LevelPicture::at(
    const Eigen::Vector2d& pixel) const {
  const auto middle = placeAt(pixel);
  const auto right = placeAt(pixel + Eigen::Vector2d(kAcross_px, 0.0));
  const auto left = placeAt(pixel - Eigen::Vector2d(kAcross_px, 0.0));
  const auto below = placeAt(pixel + Eigen::Vector2d(0.0, kAcross_px));
  const auto above = placeAt(pixel - Eigen::Vector2d(0.0, kAcross_px));
  if (!middle || !right || !left || !below || !above) return std::nullopt;
  const Eigen::Vector3d normal = (*right - *left).cross(*above - *below).normalized();
  const Eigen::Vector3d towards = (camera_.centreInTable() - *middle).normalized();
  if (!(normal.dot(towards) >= std::cos(radFromDeg(kSteepest_deg)))) return std::nullopt;
  return std::pair{*middle, normal};
}

std::optional<Eigen::Vector3d> LevelPicture::placeAt(const Eigen::Vector2d& pixel) const {
  const auto x = static_cast<int>(std::lround(pixel.x()));
  const auto y = static_cast<int>(std::lround(pixel.y()));
  if (x < 0 || y < 0 || x >= depth_.cols || y >= depth_.rows) return std::nullopt;
  const auto depth_mm = static_cast<double>(depth_.at<float>(y, x));
  if (depth_mm <= 0.0) return std::nullopt;
  const Eigen::Vector2d ahead = camera_.intrinsics.normalizedFromPixel(pixel);
  return camera_.cam_from_table.inverse() * (depth_mm * ahead.homogeneous()).eval();
}

}  // namespace gyre
