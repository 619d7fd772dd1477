// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/vertex_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/mesh/depth_map.h"
#include "core/mesh/edges.h"
#include "core/mesh/kd_tree.h"

namespace gyre {
namespace {

constexpr std::size_t kPicturesAsked = 36;
constexpr double kSteepest_deg = 70.0;
constexpr int kDepthWidth_px = 640;  // of the depth map, about
constexpr std::size_t kGrain = 1024;

// A colour that one picture shows of a vertex.
struct Sample {
  Rgb rgb{};
  std::uint8_t weight = 0;  // 255 for a look along the normal; 0: not shown
};

// Between pixels; the place lies in the picture with a pixel to spare.
Rgb colourAt(const cv::Mat& image_bgr, const Eigen::Vector2d& pixel) {
  const auto x = static_cast<int>(pixel.x());
  const auto y = static_cast<int>(pixel.y());
  const double right = pixel.x() - x;
  const double down = pixel.y() - y;
  Rgb rgb{};
  for (int channel = 0; channel < 3; ++channel) {
    const double upper = (1.0 - right) * image_bgr.at<cv::Vec3b>(y, x)[channel] +
                         right * image_bgr.at<cv::Vec3b>(y, x + 1)[channel];
    const double lower = (1.0 - right) * image_bgr.at<cv::Vec3b>(y + 1, x)[channel] +
                         right * image_bgr.at<cv::Vec3b>(y + 1, x + 1)[channel];
    rgb[static_cast<std::size_t>(2 - channel)] =
        static_cast<std::uint8_t>(std::lround((1.0 - down) * upper + down * lower));
  }
  return rgb;
}

// One camera's look at the surface.
class Look {
 public:
  Look(const Mesh& mesh, const PosedCamera& camera, cv::Mat image_bgr)
      : camera_(camera),
        centre_(camera.centreInTable()),
        shrink_(std::max(1, camera.intrinsics.width_px / kDepthWidth_px)),
        depth_(depthMap(mesh, camera, shrink_)),
        image_bgr_(std::move(image_bgr)) {}

  Sample at(const MeshVertex& vertex) const {
    const double cosine = vertex.normal.dot((centre_ - vertex.position).normalized());
    if (cosine < std::cos(radFromDeg(kSteepest_deg))) return {};
    const Eigen::Vector3d in_cam = camera_.cam_from_table * vertex.position;
    const auto pixel = camera_.intrinsics.project(in_cam);
    if (!pixel || !camera_.intrinsics.contains(*pixel, 2.0)) return {};
    if (hidden(*pixel, in_cam.z(), cosine)) return {};
    return {colourAt(image_bgr_, *pixel),
            static_cast<std::uint8_t>(std::max(1L, std::lround(255.0 * cosine)))};
  }

 private:
  // Something lies nearer at the pixel or right beside it, by more than the surface's own slant.
  bool hidden(const Eigen::Vector2d& pixel, double depth_mm, double cosine) const {
    const double mm_a_pixel = shrink_ * depth_mm / camera_.intrinsics.fx;
    const double slant_mm = 2.0 * mm_a_pixel * std::sqrt(1.0 - cosine * cosine) / cosine;
    const double tolerance_mm = slant_mm + 2.0 * mm_a_pixel;
    const auto x = static_cast<int>(std::lround((pixel.x() + 0.5) / shrink_ - 0.5));
    const auto y = static_cast<int>(std::lround((pixel.y() + 0.5) / shrink_ - 0.5));
    for (int row = std::max(0, y - 1); row <= std::min(depth_.rows - 1, y + 1); ++row) {
      for (int column = std::max(0, x - 1); column <= std::min(depth_.cols - 1, x + 1); ++column) {
        if (depth_.at<float>(row, column) < depth_mm - tolerance_mm) return true;
      }
    }
    return false;
  }

  const PosedCamera& camera_;
  Eigen::Vector3d centre_;  // of the camera, in the table frame
  int shrink_;
  cv::Mat depth_;
  cv::Mat image_bgr_;
};

// Of each channel by itself; the samples' order in memory changes.
std::optional<Rgb> weightedMedian(std::vector<Sample>& samples) {
  std::erase_if(samples, [](const Sample& each) { return each.weight == 0; });
  if (samples.empty()) return std::nullopt;
  int half = 0;
  for (const Sample& each : samples) half += each.weight;
  half = (half + 1) / 2;
  Rgb rgb{};
  for (std::size_t channel = 0; channel < rgb.size(); ++channel) {
    std::sort(samples.begin(), samples.end(), [channel](const Sample& a, const Sample& b) {
      return a.rgb[channel] < b.rgb[channel];
    });
    int so_far = 0;
    for (const Sample& each : samples) {
      so_far += each.weight;
      rgb[channel] = each.rgb[channel];
      if (so_far >= half) break;
    }
  }
  return rgb;
}

// Colours spread over edges, ring by ring, from the vertices that have one.
void spread(Mesh& mesh, std::vector<char> coloured) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  const std::vector<EdgeUse> uses = edgeUses(mesh.triangles);
  forEachEdge(uses, [&](auto begin, auto) { edges.push_back({begin->low, begin->high}); });
  for (bool more = true; more;) {
    std::vector<Eigen::Vector4d> sums(mesh.vertices.size(), Eigen::Vector4d::Zero());
    std::vector<std::uint32_t> reached;
    const auto give = [&](std::uint32_t from, std::uint32_t to) {
      if (!coloured[from] || coloured[to]) return;
      if (sums[to].w() == 0.0) reached.push_back(to);
      const Rgb& rgb = mesh.vertices[from].rgb;
      sums[to] += Eigen::Vector4d(rgb[0], rgb[1], rgb[2], 1.0);
    };
    std::erase_if(edges, [&](const auto& edge) { return coloured[edge[0]] && coloured[edge[1]]; });
    for (const auto& [a, b] : edges) {
      give(a, b);
      give(b, a);
    }
    for (const std::uint32_t vertex : reached) {
      for (Eigen::Index channel = 0; channel < 3; ++channel) {
        mesh.vertices[vertex].rgb[static_cast<std::size_t>(channel)] =
            static_cast<std::uint8_t>(std::lround(sums[vertex][channel] / sums[vertex].w()));
      }
      coloured[vertex] = 1;
    }
    more = !reached.empty();
  }
}

Error otherSize() {
  return {Error::Code::kInvalidInput,
          "A picture of the scan is not of the size that its calibration is for.",
          "Check that the pictures beside the points are those of the scan."};
}

}  // namespace

Result<std::size_t> colourVertices(Mesh& mesh, std::span<const PosedCamera> cameras,
                                   const PictureOfView& picture_of, const Task& task) {
  const std::size_t asked = std::min(kPicturesAsked, cameras.size());
  std::vector<Sample> samples(asked * mesh.vertices.size());
  for (std::size_t i = 0; i < asked; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(asked),
                "Taking colours from pictures");
    const std::size_t view = i * cameras.size() / asked;
    auto image_bgr = picture_of(view);
    if (!image_bgr) return image_bgr.error();
    const CameraModel& intrinsics = cameras[view].intrinsics;
    if (image_bgr->cols != intrinsics.width_px || image_bgr->rows != intrinsics.height_px ||
        image_bgr->type() != CV_8UC3) {
      return otherSize();
    }
    const Look look(mesh, cameras[view], std::move(*image_bgr));
    parallelFor(mesh.vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        samples[v * asked + i] = look.at(mesh.vertices[v]);
      }
    });
  }
  std::vector<char> coloured(mesh.vertices.size(), 0);
  parallelFor(mesh.vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto from = samples.begin() + static_cast<std::ptrdiff_t>(v * asked);
      std::vector<Sample> shown(from, from + static_cast<std::ptrdiff_t>(asked));
      if (const auto rgb = weightedMedian(shown)) {
        mesh.vertices[v].rgb = *rgb;
        coloured[v] = 1;
      }
      mesh.vertices[v].views = static_cast<std::uint16_t>(shown.size());
    }
  });
  const auto count = std::count(coloured.begin(), coloured.end(), char{1});
  spread(mesh, std::move(coloured));
  return static_cast<std::size_t>(count);
}

void colourFromPoints(Mesh& mesh, const PointCloud& cloud) {
  GYRE_CHECK(!cloud.points.empty());
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Point& point : cloud.points) positions.push_back(point.position);
  const KdTree tree(std::move(positions));
  parallelFor(mesh.vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto nearest = tree.nearest(mesh.vertices[v].position, 1);
      mesh.vertices[v].rgb = cloud.points[nearest.front().index].rgb;
    }
  });
}

}  // namespace gyre
