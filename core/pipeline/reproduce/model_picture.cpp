// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/model_picture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/sim/ray_scene.h"

namespace gyre {
namespace {

// Blue, green, red.
const cv::Scalar kPaper(255, 255, 255);
const Eigen::Vector3d kClay(190.0, 205.0, 215.0);
const Eigen::Vector3d kWithin(60.0, 60.0, 150.0);
constexpr double kAmbient = 0.25;
constexpr int kDot_px = 2;  // radius, in a picture 1280 pixels wide
constexpr int kDotPictureWidth_px = 1280;

cv::Vec3b shade(const Eigen::Vector3d& bgr, double light) {
  const Eigen::Vector3d lit = std::clamp(light, 0.0, 1.0) * bgr;
  return {cv::saturate_cast<uchar>(lit.x()), cv::saturate_cast<uchar>(lit.y()),
          cv::saturate_cast<uchar>(lit.z())};
}

Eigen::Vector3d normalOf(const Mesh& mesh, const RayHit& hit) {
  const Triangle& corners = mesh.triangles[hit.triangle];
  const double u = hit.u;
  const double v = hit.v;
  return ((1.0 - u - v) * mesh.vertices[corners[0]].normal + u * mesh.vertices[corners[1]].normal +
          v * mesh.vertices[corners[2]].normal)
      .normalized();
}

}  // namespace

cv::Mat pictureOfSurface(const Mesh& mesh, const CameraModel& camera,
                         const Rigid3& cam_from_table) {
  cv::Mat picture(camera.height_px, camera.width_px, CV_8UC3, kPaper);
  if (mesh.triangles.empty()) return picture;
  const RayScene scene(mesh);
  const Rigid3 table_from_cam = cam_from_table.inverse();
  const Eigen::Vector3d light =
      table_from_cam.rotation * Eigen::Vector3d(-0.5, -0.7, -1.0).normalized();
  parallelFor(
      static_cast<std::size_t>(camera.height_px), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
          auto* row = picture.ptr<cv::Vec3b>(static_cast<int>(y));
          for (int x = 0; x < camera.width_px; x += static_cast<int>(RayPacket::kSize)) {
            RayPacket rays;
            rays.origin = table_from_cam.translation.cast<float>();
            const int count = std::min(static_cast<int>(RayPacket::kSize), camera.width_px - x);
            for (int i = 0; i < count; ++i) {
              const Eigen::Vector3d in_cam = camera.rayInCam({x + i, static_cast<double>(y)});
              const auto at = static_cast<std::size_t>(i);
              rays.direction[at] = (table_from_cam.rotation * in_cam).cast<float>();
              rays.valid[at] = true;
            }
            const auto hits = scene.closest(rays);
            for (int i = 0; i < count; ++i) {
              const auto at = static_cast<std::size_t>(i);
              if (hits[at].triangle == RayHit::kNone) continue;
              const Eigen::Vector3d normal = normalOf(mesh, hits[at]);
              const bool within = normal.dot(rays.direction[at].cast<double>()) > 0.0;
              const double lit = std::max(0.0, within ? 0.5 : normal.dot(light));
              row[x + i] = shade(within ? kWithin : kClay, kAmbient + (1.0 - kAmbient) * lit);
            }
          }
        }
      });
  return picture;
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
