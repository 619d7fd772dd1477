// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/reobservation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/base/parallel.h"
#include "core/track/reference_patch.h"

namespace gyre {
namespace {

constexpr std::size_t kGrain = 32;
// Cosine of the most oblique view, 70 degrees: beyond it a patch is squeezed to lines. A surface
// that no view meets more squarely is looked for where it is met almost as squarely as ever.
constexpr double kLeastFacing = 0.34;
constexpr double kAlmost = 0.8;
constexpr double kNeverFacing = 0.15;
// What interpolation and moving light leave beside the pictures' noise. [px]
constexpr double kAlignmentFloor_px = 0.03;

// A point as one view shows it: its pixel, and how far pixels move along its tangent plane.
struct Appearance {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d pixel_by_tangent;  // px / mm, along the two tangents
  Eigen::Vector2d pixel_by_normal;   // px / mm
};

Eigen::Matrix<double, 3, 2> tangentsOf(const SurfacePoint& point) {
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) = point.normal_in_table.unitOrthogonal();
  tangents.col(1) = point.normal_in_table.cross(tangents.col(0));
  return tangents;
}

class Observer {
 public:
  Observer(const CameraModel& camera, std::span<const GreyView> views, const TrackOptions& options)
      : camera_(camera), views_(views), options_(options) {
    centres_.reserve(views.size());
    for (const GreyView& view : views) {
      centres_.push_back(view.cam_from_table.inverse().translation);
    }
  }

  std::vector<Observation> observe(const SurfacePoint& point) const;

 private:
  double facing(const SurfacePoint& point, std::size_t view) const {
    return point.normal_in_table.dot((centres_[view] - point.position_in_table).normalized());
  }
  std::vector<std::size_t> facingViews(const SurfacePoint& point, std::size_t reference) const;
  std::optional<Appearance> appearance(const SurfacePoint& point, std::size_t view) const;

  const CameraModel& camera_;
  std::span<const GreyView> views_;
  const TrackOptions& options_;
  std::vector<Eigen::Vector3d> centres_;  // of the cameras, in the table frame
};

std::optional<Appearance> Observer::appearance(const SurfacePoint& point, std::size_t view) const {
  const Rigid3& pose = views_[view].cam_from_table;
  const Eigen::Vector3d in_cam = pose * point.position_in_table;
  const auto pixel = camera_.project(in_cam);
  if (!pixel) return std::nullopt;
  const Eigen::Vector2d normalized = in_cam.hnormalized();
  Eigen::Matrix<double, 2, 3> normalized_by_cam;
  normalized_by_cam << 1.0, 0.0, -normalized.x(), 0.0, 1.0, -normalized.y();
  normalized_by_cam /= in_cam.z();
  const Eigen::Matrix<double, 2, 3> pixel_by_table =
      camera_.pixelJacobian(normalized) * normalized_by_cam * pose.rotation;
  return Appearance{*pixel, pixel_by_table * tangentsOf(point),
                    pixel_by_table * point.normal_in_table};
}

// The views to look in, ascending, the reference among them.
std::vector<std::size_t> Observer::facingViews(const SurfacePoint& point,
                                               std::size_t reference) const {
  const double least = std::min(kLeastFacing, kAlmost * facing(point, reference));
  std::vector<std::size_t> facing_views;
  for (std::size_t view = 0; view < views_.size(); ++view) {
    if (view == reference || facing(point, view) >= least) facing_views.push_back(view);
  }
  const auto most = static_cast<std::size_t>(options_.most_views);
  if (facing_views.size() <= most) return facing_views;
  std::vector<std::size_t> spread;
  for (std::size_t k = 0; k + 1 < most; ++k) {
    spread.push_back(facing_views[k * (facing_views.size() - 1) / (most - 2)]);
  }
  spread.push_back(reference);
  std::sort(spread.begin(), spread.end());
  spread.erase(std::unique(spread.begin(), spread.end()), spread.end());
  return spread;
}

std::vector<Observation> Observer::observe(const SurfacePoint& point) const {
  std::optional<std::size_t> reference;
  double squarest = kNeverFacing;
  for (const std::size_t view : point.seen_by) {
    const double cosine = facing(point, view);
    if (cosine <= squarest) continue;
    squarest = cosine;
    reference = view;
  }
  if (!reference) return {};
  const auto there = appearance(point, *reference);
  if (!there) return {};
  const Eigen::Matrix2d tangent_by_pixel = there->pixel_by_tangent.inverse();
  const Eigen::Matrix<double, 3, 2> offset_by_pixel = tangentsOf(point) * tangent_by_pixel;
  const auto patch =
      ReferencePatch::cut(views_[*reference].grey, there->pixel, options_.window_px,
                          offset_by_pixel.transpose() * point.bending_in_table * offset_by_pixel);
  if (!patch) return {};
  std::vector<Observation> observations;
  for (const std::size_t view : facingViews(point, *reference)) {
    const double sigma_px =
        std::hypot(patch->sigmaPx(views_[view].noise_sigma), kAlignmentFloor_px);
    if (view == *reference) {
      observations.push_back({static_cast<std::int32_t>(view), there->pixel, sigma_px});
      continue;
    }
    const auto here = appearance(point, view);
    if (!here) continue;
    // A rise moves the point in both pictures; the reference's part is along the tangent plane.
    const Eigen::Matrix2d shape = here->pixel_by_tangent * tangent_by_pixel;
    const Eigen::Vector2d bend = here->pixel_by_normal - shape * there->pixel_by_normal;
    const auto found = patch->align(views_[view].grey, {here->pixel, shape, bend});
    if (!found || found->correlation < options_.min_correlation) continue;
    if ((found->place.pixel - here->pixel).norm() > options_.max_epipolar_px) continue;
    observations.push_back({static_cast<std::int32_t>(view), found->place.pixel, sigma_px});
  }
  return observations;
}

}  // namespace

Result<std::vector<std::vector<Observation>>> reobserve(const CameraModel& camera,
                                                        std::span<const GreyView> views,
                                                        std::span<const SurfacePoint> points,
                                                        const TrackOptions& options,
                                                        const Task& task) {
  const Observer observer(camera, views, options);
  std::vector<std::vector<Observation>> all(points.size());
  std::atomic<std::size_t> done = 0;
  parallelFor(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (task.stopRequested()) return;
    for (std::size_t i = begin; i < end; ++i) all[i] = observer.observe(points[i]);
    done += end - begin;
    task.report(static_cast<double>(done) / static_cast<double>(points.size()),
                "Looking at every point in every view");
  });
  if (task.stopRequested()) return cancelled();
  return all;
}

}  // namespace gyre
