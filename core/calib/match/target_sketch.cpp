// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/match/target_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/calib/match/face_print.h"
#include "core/calib/match/target_face.h"

namespace gyre {
namespace {

constexpr std::size_t kClicks = 6;
constexpr std::size_t kMostFaces = 3;
constexpr double kGrazing = 0.15;  // cosine under which a face is hardly seen

// Towards the eye, and the axes of the drawing.
struct Eye {
  Eigen::Vector3d towards;
  Eigen::Vector3d right;
  Eigen::Vector3d down;

  Eye() {
    const double elevation_rad = radFromDeg(35.0);
    const double azimuth_rad = radFromDeg(45.0);
    towards = {std::cos(elevation_rad) * std::cos(azimuth_rad),
               std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
    right = Eigen::Vector3d::UnitZ().cross(towards).normalized();
    down = right.cross(towards);
  }
  Eigen::Vector2d at(const Eigen::Vector3d& point) const {
    return {right.dot(point), down.dot(point)};
  }
};

std::vector<Eigen::Vector3d> pointsOn(const TargetFace& face) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(face.corners.size());
  for (const auto& corner : face.corners) points.push_back(face.pointAt(corner.place_mm));
  return points;
}

// The rectangle around the face's corners, a square wider on each side, in the target frame.
std::array<Eigen::Vector3d, 4> outlineOf(const TargetFace& face) {
  Eigen::AlignedBox2d box;
  for (const auto& corner : face.corners) box.extend(corner.place_mm);
  const double margin_mm = face.grid->pitch_mm.maxCoeff();
  const Eigen::Vector2d low = box.min().array() - margin_mm;
  const Eigen::Vector2d high = box.max().array() + margin_mm;
  return {face.pointAt(low), face.pointAt({high.x(), low.y()}), face.pointAt(high),
          face.pointAt({low.x(), high.y()})};
}

TargetSketch::Face drawnBy(const Eye& eye, const Target& target, const TargetFace& face) {
  TargetSketch::Face drawn;
  for (const Eigen::Vector3d& point : outlineOf(face)) drawn.outline.push_back(eye.at(point));
  for (const PrintedArea& printed : printOf(target, face)) {
    TargetSketch::Area area;
    area.dark = printed.dark;
    area.outline.reserve(printed.outline_in_target.size());
    for (const Eigen::Vector3d& point : printed.outline_in_target) {
      area.outline.push_back(eye.at(point));
    }
    drawn.print.push_back(std::move(area));
  }
  return drawn;
}

// The seen faces, the best first.
std::vector<const TargetFace*> seenFaces(const std::vector<TargetFace>& faces, const Eye& eye) {
  std::vector<const TargetFace*> seen;
  for (const TargetFace& face : faces) {
    if (face.grid && face.outwardInTarget().dot(eye.towards) > kGrazing) {
      seen.push_back(&face);
    }
  }
  std::stable_sort(seen.begin(), seen.end(), [&](const TargetFace* a, const TargetFace* b) {
    return a->outwardInTarget().dot(eye.towards) > b->outwardInTarget().dot(eye.towards);
  });
  return seen;
}

// So many corners of a face, each as far as can be from those before: indices.
std::vector<std::size_t> spread(const std::vector<Eigen::Vector3d>& points, std::size_t count) {
  std::vector<std::size_t> chosen = {0};
  while (chosen.size() < std::min(count, points.size())) {
    std::size_t best = 0;
    double farthest = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      double nearest = 1e18;
      for (const std::size_t j : chosen)
        nearest = std::min(nearest, (points[i] - points[j]).norm());
      if (nearest <= farthest) continue;
      farthest = nearest;
      best = i;
    }
    chosen.push_back(best);
  }
  return chosen;
}

}  // namespace

TargetSketch sketchOf(const Target& target) {
  const Eye eye;
  const std::vector<TargetPoint> points = pointsOf(target);
  const std::vector<TargetFace> faces = facesOf(target);
  const std::vector<const TargetFace*> seen = seenFaces(faces, eye);
  TargetSketch sketch;
  Eigen::AlignedBox2d box;
  for (auto face = seen.rbegin(); face != seen.rend(); ++face) {
    sketch.faces.push_back(drawnBy(eye, target, **face));
    for (const Eigen::Vector2d& place : sketch.faces.back().outline) box.extend(place);
    for (const auto& corner : (*face)->corners) {
      const auto& point = points[static_cast<std::size_t>(corner.point)];
      sketch.corners.push_back({point.corner_id, eye.at((*face)->pointAt(corner.place_mm))});
    }
  }
  if (box.isEmpty()) return sketch;
  const double side = box.sizes().maxCoeff();
  const auto normalised = [&](Eigen::Vector2d& place) {
    place = (place - box.center()) / side + Eigen::Vector2d(0.5, 0.5);
  };
  for (auto& face : sketch.faces) {
    std::for_each(face.outline.begin(), face.outline.end(), normalised);
    for (auto& area : face.print)
      std::for_each(area.outline.begin(), area.outline.end(), normalised);
  }
  for (auto& corner : sketch.corners) normalised(corner.place);

  const std::size_t used = std::min(seen.size(), kMostFaces);
  if (used < 2) return sketch;
  for (std::size_t i = 0; i < used; ++i) {
    for (const std::size_t corner : spread(pointsOn(*seen[i]), kClicks / used)) {
      const auto point = static_cast<std::size_t>(seen[i]->corners[corner].point);
      sketch.to_click.push_back(points[point].corner_id);
    }
  }
  if (sketch.to_click.size() < kClicks) sketch.to_click.clear();
  return sketch;
}

}  // namespace gyre
