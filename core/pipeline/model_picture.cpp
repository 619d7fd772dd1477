// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/model_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/sim/ray_scene.h"

namespace gyre {
namespace {

// Blue, green, red.
const cv::Scalar kPaper(255, 255, 255);
const Eigen::Vector3d kClay(190.0, 205.0, 215.0);
const Eigen::Vector3d kWithin(60.0, 60.0, 150.0);
const Eigen::Vector3d kHatch(255.0, 255.0, 255.0);
constexpr double kAmbient = 0.25;
constexpr double kAmbientOfColours = 0.6;  // they carry the light of the scan already
constexpr double kAmbientOfFigures = 0.75;
constexpr double kHatchWeight = 0.6;
constexpr double kHatchShare = 0.012;  // of the picture's width: from stripe to stripe
constexpr double kViewAngle_rad = 12.0 * kPi / 180.0;
constexpr double kMargin = 1.04;
constexpr int kDot_px = 2;  // radius, in a picture 1280 pixels wide
constexpr int kDotPictureWidth_px = 1280;

cv::Vec3b shade(const Eigen::Vector3d& bgr, double light) {
  const Eigen::Vector3d lit = std::clamp(light, 0.0, 1.0) * bgr;
  return {cv::saturate_cast<uchar>(lit.x()), cv::saturate_cast<uchar>(lit.y()),
          cv::saturate_cast<uchar>(lit.z())};
}

// What of the surface a ray met.
struct Met {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d bgr = Eigen::Vector3d::Zero();
  double seen = 0.0;  // share of it that cameras saw, blended between the corners
};

Met metBy(const Mesh& mesh, const RayHit& hit) {
  const Triangle& corners = mesh.triangles[hit.triangle];
  const double u = hit.u;
  const double v = hit.v;
  const std::array<double, 3> weights = {1.0 - u - v, u, v};
  Met met;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshVertex& vertex = mesh.vertices[corners[k]];
    met.normal += weights[k] * vertex.normal;
    met.bgr += weights[k] * Eigen::Vector3d(vertex.rgb[2], vertex.rgb[1], vertex.rgb[0]);
    if (vertex.seen != 0) met.seen += weights[k];
  }
  if (met.normal.isZero()) {
    const Eigen::Vector3d& first = mesh.vertices[corners[0]].position;
    met.normal = (mesh.vertices[corners[1]].position - first)
                     .cross(mesh.vertices[corners[2]].position - first);
  }
  met.normal.normalize();
  return met;
}

// One picture of one surface.
class SurfacePainter {
 public:
  SurfacePainter(const Mesh& mesh, const RayScene& scene, const PosedCamera& view,
                 SurfacePaint paint)
      : mesh_(mesh),
        scene_(scene),
        camera_(view.intrinsics),
        table_from_cam_(view.cam_from_table.inverse()),
        light_(table_from_cam_.rotation * Eigen::Vector3d(-0.5, -0.7, -1.0).normalized()),
        paint_(paint) {}

  void paintRow(int y, cv::Vec3b* row) const {
    for (int x = 0; x < camera_.width_px; x += static_cast<int>(RayPacket::kSize)) {
      RayPacket rays;
      rays.origin = table_from_cam_.translation.cast<float>();
      const int count = std::min(static_cast<int>(RayPacket::kSize), camera_.width_px - x);
      for (int i = 0; i < count; ++i) {
        const Eigen::Vector3d in_cam = camera_.rayInCam({x + i, static_cast<double>(y)});
        const auto at = static_cast<std::size_t>(i);
        rays.direction[at] = (table_from_cam_.rotation * in_cam).cast<float>();
        rays.valid[at] = true;
      }
      const auto hits = scene_.closest(rays);
      for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (hits[at].triangle == RayHit::kNone) continue;
        row[x + i] = colourOf(metBy(mesh_, hits[at]), rays.direction[at].cast<double>(), x + i + y);
      }
    }
  }

 private:
  // diagonal_px: which of the hatching's lines the pixel lies on.
  cv::Vec3b colourOf(const Met& met, const Eigen::Vector3d& direction, int diagonal_px) const {
    const bool within = met.normal.dot(direction) > 0.0;
    const double facing = within ? 0.5 : std::max(0.0, met.normal.dot(light_));
    if (paint_ == SurfacePaint::kFigures) {
      const double lit = std::abs(met.normal.dot(direction.normalized()));
      return shade(met.bgr, kAmbientOfFigures + (1.0 - kAmbientOfFigures) * lit);
    }
    if (paint_ == SurfacePaint::kClay || within) {
      return shade(within ? kWithin : kClay, kAmbient + (1.0 - kAmbient) * facing);
    }
    const double light = kAmbientOfColours + (1.0 - kAmbientOfColours) * facing;
    Eigen::Vector3d bgr = light * met.bgr;
    const int stripe_px = std::max(4, static_cast<int>(kHatchShare * camera_.width_px));
    if (met.seen < 0.5 && diagonal_px % stripe_px < stripe_px / 2) {
      bgr += kHatchWeight * (kHatch - bgr);
    }
    return shade(bgr, 1.0);
  }

  const Mesh& mesh_;
  const RayScene& scene_;
  const CameraModel& camera_;
  Rigid3 table_from_cam_;
  Eigen::Vector3d light_;  // towards it, in the table frame
  SurfacePaint paint_;
};

}  // namespace

PosedCamera viewOf(const Bounds& bounds, double azimuth_rad, double elevation_rad, int size_px) {
  PosedCamera view;
  CameraModel& camera = view.intrinsics;
  camera.width_px = camera.height_px = size_px;
  camera.cx = camera.cy = 0.5 * (size_px - 1);
  const Eigen::Vector3d half = bounds.empty() ? Eigen::Vector3d(0.5, 0.5, 0.5)
                                              : Eigen::Vector3d(0.5 * (bounds.max - bounds.min));
  const Eigen::Vector3d middle =
      bounds.empty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(0.5 * (bounds.min + bounds.max));
  // Of the upright cylinder around the box, so that all azimuths have one scale.
  const double radius_mm = std::max(1e-9, half.norm());
  const double distance_mm = radius_mm / std::sin(0.5 * kViewAngle_rad);
  const double across_mm = half.head<2>().norm();
  const double tall_mm =
      half.z() * std::abs(std::cos(elevation_rad)) + across_mm * std::abs(std::sin(elevation_rad));
  const double extent_mm = std::max({1e-9, across_mm, tall_mm});
  camera.fx = camera.fy = 0.5 * size_px * (distance_mm - radius_mm) / (kMargin * extent_mm);
  const double c = std::cos(elevation_rad);
  const Eigen::Vector3d outward(c * std::cos(azimuth_rad), c * std::sin(azimuth_rad),
                                std::sin(elevation_rad));
  const Eigen::Vector3d right(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
  Eigen::Matrix3d& rotation = view.cam_from_table.rotation;
  rotation.row(0) = right;
  rotation.row(1) = right.cross(outward);  // down
  rotation.row(2) = -outward;
  const Eigen::Vector3d eye = middle + distance_mm * outward;
  view.cam_from_table.translation = -(rotation * eye);
  return view;
}

std::vector<cv::Mat> picturesOfSurface(const Mesh& mesh, std::span<const PosedCamera> views,
                                       SurfacePaint paint) {
  std::vector<cv::Mat> pictures;
  for (const PosedCamera& view : views) {
    pictures.emplace_back(view.intrinsics.height_px, view.intrinsics.width_px, CV_8UC3, kPaper);
  }
  if (mesh.triangles.empty()) return pictures;
  const RayScene scene(mesh);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SurfacePainter painter(mesh, scene, views[i], paint);
    cv::Mat& picture = pictures[i];
    parallelFor(static_cast<std::size_t>(picture.rows), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        const int row = static_cast<int>(y);
        painter.paintRow(row, picture.ptr<cv::Vec3b>(row));
      }
    });
  }
  return pictures;
}

cv::Mat pictureOfSurface(const Mesh& mesh, const CameraModel& camera,
                         const Rigid3& cam_from_table) {
  const PosedCamera view{camera, cam_from_table};
  return picturesOfSurface(mesh, {&view, 1}, SurfacePaint::kClay).front();
}

cv::Mat pictureOfPoints(const PointCloud& cloud, const CameraModel& camera,
                        const Rigid3& cam_from_table) {
  cv::Mat picture(camera.height_px, camera.width_px, CV_8UC3, kPaper);
  const Eigen::Vector3d centre = cam_from_table.inverse().translation;
  std::vector<std::pair<double, const Point*>> facing;
  facing.reserve(cloud.points.size());
  for (const Point& point : cloud.points) {
    if (point.normal.dot(centre - point.position) < 0.0) continue;
    facing.emplace_back((cam_from_table * point.position).z(), &point);
  }
  std::stable_sort(facing.begin(), facing.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const int radius_px = std::max(1, kDot_px * camera.width_px / kDotPictureWidth_px);
  for (const auto& [depth, point] : facing) {
    const auto pixel = camera.project(cam_from_table * point->position);
    if (!pixel || !camera.contains(*pixel)) continue;
    cv::circle(picture, cv::Point(cvRound(pixel->x()), cvRound(pixel->y())), radius_px,
               cv::Scalar(point->rgb[2], point->rgb[1], point->rgb[0]), cv::FILLED, cv::LINE_AA);
  }
  return picture;
}

}  // namespace gyre
