// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sheet_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/base/units.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kFoldUse = 51;
constexpr double kLevel = 0.99;  // cosine between its normal and the vertical

double foldSign(const RigSettings& rig, int face) {
  Random random(hashWords(
      {static_cast<std::uint64_t>(rig.seed), kFoldUse, static_cast<std::uint64_t>(face)}));
  return random.uniform() < 0.5 ? -1.0 : 1.0;
}

// A place on the edge about which the sheet is folded: the one that is furthest along `way`.
Vector2d furthestPlace(const TargetSheet& sheet, const Vector2d& way) {
  Vector2d furthest = Vector2d::Zero();
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& piece : sheet.pieces) {
    for (const Vector2d& place : piece) {
      if (way.dot(place) <= most) continue;
      most = way.dot(place);
      furthest = place;
    }
  }
  return furthest;
}

}  // namespace

SheetShape::SheetShape(const TargetSheet& sheet, const RigSettings& rig, std::size_t sheets)
    : right_(sheet.right), down_(sheet.down), outward_(sheet.outward()) {
  const double even = 0.5 * (rig.print_scale_right + rig.print_scale_down);
  middle_ = even * sheet.middle;
  stretch_ = sheet.has_page_axes ? Vector2d(rig.print_scale_right, rig.print_scale_down)
                                 : Vector2d::Constant(even);
  if (sheet.face < 0) return;
  double half_width = 0.0;
  for (const auto& piece : sheet.pieces) {
    for (const Vector2d& place : piece) half_width = std::max(half_width, std::abs(place.x()));
  }
  half_width_mm_ = stretch_.x() * half_width;
  bow_mm_ = rig.target_bow_mm;
  if (sheets < 2 || rig.target_fold_error_deg == 0.0) return;
  const bool level = std::abs(outward_.z()) > kLevel;
  const Vector2d way = level ? Vector2d::UnitY() : Vector2d(-right_.z(), -down_.z());
  const Vector3d hinge = level ? right_ : Vector3d(outward_.cross(Vector3d::UnitZ()).normalized());
  const Vector3d on_hinge = bentInTarget(furthestPlace(sheet, way));
  const double angle_rad = radFromDeg(rig.target_fold_error_deg) * foldSign(rig, sheet.face);
  folded_from_flat_.rotation = Eigen::AngleAxisd(angle_rad, hinge).toRotationMatrix();
  folded_from_flat_.translation = on_hinge - folded_from_flat_.rotation * on_hinge;
}

Vector3d SheetShape::bentInTarget(const Vector2d& place) const {
  // z = bow (1 - s^2 / R^2) over the length s along the paper; its slope z' shortens x by the
  // integral of z'^2 / 2.
  const double s = stretch_.x() * place.x();
  const double share = s / half_width_mm_;
  const double x = s - 2.0 / 3.0 * bow_mm_ * bow_mm_ / half_width_mm_ * share * share * share;
  return middle_ + x * right_ + stretch_.y() * place.y() * down_ +
         bow_mm_ * (1.0 - share * share) * outward_;
}

Vector3d SheetShape::inTarget(const Vector2d& place) const {
  return folded_from_flat_ * bentInTarget(place);
}

Target trueTarget(const Target& target, const std::vector<TargetSheet>& sheets,
                  const RigSettings& rig) {
  std::vector<SheetShape> shapes;
  shapes.reserve(sheets.size());
  for (const TargetSheet& sheet : sheets) shapes.emplace_back(sheet, rig, sheets.size());
  const auto moved = [&](const TargetPoint& point) -> Vector3d {
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      const TargetSheet& sheet = sheets[i];
      const double off = sheet.outward().dot(point.position_in_target - sheet.middle);
      if (sheet.face == point.face && (sheet.face >= 0 || std::abs(off) < 0.05)) {
        return shapes[i].inTarget(sheet.placeOf(point.position_in_target));
      }
    }
    return point.position_in_target;
  };
  const std::vector<TargetPoint> points = pointsOf(target);
  Target truth = target;
  std::size_t next = 0;
  for (TargetCorner& corner : truth.corners) corner.position_in_target = moved(points[next++]);
  for (TargetMarker& marker : truth.markers) {
    for (Vector3d& corner : marker.corners_in_target) corner = moved(points[next++]);
  }
  return truth;
}

}  // namespace gyre
