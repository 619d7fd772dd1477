// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/epipolar_search.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/ray.h"
#include "core/track/correlation.h"

namespace gyre {
namespace {

constexpr int kMostCandidates = 400;

}  // namespace

std::optional<EpipolarMatch> EpipolarSearch::find(const cv::Mat& from_grey,
                                                  const Rigid3& from_cam_from_table,
                                                  const Eigen::Vector2d& from_pixel,
                                                  const cv::Mat& to_grey,
                                                  const Rigid3& to_cam_from_table) const {
  const auto patch = samplePatch(from_grey, from_pixel);
  if (!patch) return std::nullopt;
  const Rigid3 table_from_cam = from_cam_from_table.inverse();
  const Ray ray{table_from_cam.translation, table_from_cam.rotation * camera_.rayInCam(from_pixel)};
  auto span = crossCylinder(ray, volume_.radius_mm, volume_.z_min_mm, volume_.z_max_mm);
  if (!span || span->to <= 0.0) return std::nullopt;
  span->from = std::max(span->from, 1.0);

  // Coarse projections along the ray give the curve; each piece is then walked pixel by pixel.
  const auto pixel_at = [&](double share) {
    const double distance = span->from + share * (span->to - span->from);
    return camera_.project(to_cam_from_table * (ray.origin + distance * ray.direction));
  };
  constexpr int kPieces = 8;
  std::optional<EpipolarMatch> best;
  int candidates = 0;
  auto previous = pixel_at(0.0);
  for (int piece = 1; piece <= kPieces; ++piece) {
    const auto next = pixel_at(static_cast<double>(piece) / kPieces);
    if (previous && next) {
      const Eigen::Vector2d along = *next - *previous;
      const int steps = std::max(1, static_cast<int>(std::ceil(along.lpNorm<Eigen::Infinity>())));
      for (int step = 0; step < steps && candidates < kMostCandidates; ++step, ++candidates) {
        const Eigen::Vector2d at = *previous + along * (static_cast<double>(step) / steps);
        const float correlation =
            correlateAt(*patch, to_grey, static_cast<int>(std::lround(at.x())),
                        static_cast<int>(std::lround(at.y())));
        if (!best || correlation > best->correlation) best = EpipolarMatch{at, correlation};
      }
    }
    previous = next;
  }
  return best;
}

}  // namespace gyre
