// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/depth_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/check.h"

namespace gyre {
namespace {

// A vertex in the small picture: pixel, and one over its depth, which runs evenly over a plane.
struct Seen {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double inverse_depth = 0.0;  // 0: not seen
};

std::vector<Seen> projected(const Mesh& mesh, const PosedCamera& camera, int shrink) {
  std::vector<Seen> seen(mesh.vertices.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Eigen::Vector3d in_cam = camera.cam_from_table * mesh.vertices[i].position;
    const auto pixel = camera.intrinsics.project(in_cam);
    if (!pixel) continue;
    seen[i] = {(*pixel + Eigen::Vector2d::Constant(0.5)) / shrink - Eigen::Vector2d::Constant(0.5),
               1.0 / in_cam.z()};
  }
  return seen;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

void fill(const std::array<Seen, 3>& corner, cv::Mat& depth) {
  const Eigen::Vector2d low = corner[0].pixel.cwiseMin(corner[1].pixel).cwiseMin(corner[2].pixel);
  const Eigen::Vector2d high = corner[0].pixel.cwiseMax(corner[1].pixel).cwiseMax(corner[2].pixel);
  if (high.x() < 0.0 || high.y() < 0.0 || low.x() > depth.cols - 1 || low.y() > depth.rows - 1) {
    return;
  }
  const Eigen::Vector2d first = corner[1].pixel - corner[0].pixel;
  const Eigen::Vector2d second = corner[2].pixel - corner[0].pixel;
  const double area = cross(first, second);
  if (area == 0.0) return;
  const int last_row = std::min(depth.rows - 1, static_cast<int>(std::floor(high.y())));
  const int last_column = std::min(depth.cols - 1, static_cast<int>(std::floor(high.x())));
  for (int y = std::max(0, static_cast<int>(std::ceil(low.y()))); y <= last_row; ++y) {
    for (int x = std::max(0, static_cast<int>(std::ceil(low.x()))); x <= last_column; ++x) {
      const Eigen::Vector2d here = Eigen::Vector2d(x, y) - corner[0].pixel;
      const double b = cross(here, second) / area;
      const double c = cross(first, here) / area;
      if (b < 0.0 || c < 0.0 || b + c > 1.0) continue;
      const double inverse = (1.0 - b - c) * corner[0].inverse_depth + b * corner[1].inverse_depth +
                             c * corner[2].inverse_depth;
      auto& nearest = depth.at<float>(y, x);
      nearest = std::min(nearest, static_cast<float>(1.0 / inverse));
    }
  }
}

}  // namespace

cv::Mat depthMap(const Mesh& mesh, const PosedCamera& camera, int shrink) {
  GYRE_CHECK(shrink >= 1);
  cv::Mat depth(camera.intrinsics.height_px / shrink, camera.intrinsics.width_px / shrink, CV_32F,
                cv::Scalar(std::numeric_limits<float>::infinity()));
  const std::vector<Seen> seen = projected(mesh, camera, shrink);
  for (const auto& [a, b, c] : mesh.triangles) {
    if (seen[a].inverse_depth <= 0.0 || seen[b].inverse_depth <= 0.0 ||
        seen[c].inverse_depth <= 0.0) {
      continue;
    }
    fill({seen[a], seen[b], seen[c]}, depth);
  }
  return depth;
}

}  // namespace gyre
