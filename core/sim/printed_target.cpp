// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/printed_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/base/units.h"
#include "core/sim/convex_body.h"
#include "core/sim/polygon_clip.h"
#include "core/sim/sheet_shape.h"
#include "core/sim/target_sheets.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kPaper = 0.86F;  // reflectance of matte white paper
constexpr float kInk = 0.04F;    // and of toner on it
constexpr int kStrips = 64;      // of a bent sheet: the chords stay within bow / 64^2 of the arc
constexpr double kBodyInset_mm = 0.1;
constexpr double kLeastBody_mm = 2.0;
constexpr std::size_t kMostBodyPoints = 64;

// Sub-pixel offsets: a Fibonacci lattice, so that an edge along rows or columns crosses it in 55
// steps and one across them is averaged.
constexpr int kSamples = 55;
constexpr int kGenerator = 34;
std::array<Vector2d, kSamples> subPixels() {
  std::array<Vector2d, kSamples> offsets;
  for (int i = 0; i < kSamples; ++i) {
    offsets[static_cast<std::size_t>(i)] =
        Vector2d((i + 0.5) / kSamples - 0.5, ((i * kGenerator) % kSamples + 0.5) / kSamples - 0.5);
  }
  return offsets;
}

// Bent sheets are cut into strips along the page, flat ones stay whole.
std::vector<std::vector<Vector2d>> stripsOf(const std::vector<Vector2d>& piece, bool bent) {
  if (!bent) return {piece};
  double left = piece.front().x();
  double right = left;
  for (const Vector2d& place : piece) {
    left = std::min(left, place.x());
    right = std::max(right, place.x());
  }
  std::vector<std::vector<Vector2d>> strips;
  for (int i = 0; i < kStrips; ++i) {
    const double from = left + (right - left) * i / kStrips;
    const double to = left + (right - left) * (i + 1) / kStrips;
    auto strip = clipped(clipped(piece, {-Vector2d::UnitX(), -from}), {Vector2d::UnitX(), to});
    if (!strip.empty()) strips.push_back(std::move(strip));
  }
  return strips;
}

// The body stands back behind the sheets by what they may lean or bow inward. None when the sheets
// do not stand around a middle: a board, markers, faces that look at each other.
std::vector<std::array<Vector3d, 3>> bodyOf(const std::vector<TargetSheet>& sheets,
                                            const RigSettings& rig) {
  std::vector<Vector3d> rim;
  for (const TargetSheet& sheet : sheets) {
    for (const auto& piece : sheet.pieces) {
      for (const Vector2d& place : piece) rim.push_back(sheet.inTarget(place));
    }
  }
  if (rim.size() < 4 || rim.size() > kMostBodyPoints) return {};
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : rim) middle += point / static_cast<double>(rim.size());
  double nearest = std::numeric_limits<double>::infinity();
  double size = 0.0;
  for (const Vector3d& point : rim) size = std::max(size, 2.0 * (point - middle).norm());
  for (const TargetSheet& sheet : sheets) {
    nearest = std::min(nearest, sheet.outward().dot(sheet.middle - middle));
    for (const Vector3d& point : rim) {
      if (sheet.outward().dot(point - sheet.middle) > kBodyInset_mm) return {};
    }
  }
  const double even = 0.5 * (rig.print_scale_right + rig.print_scale_down);
  const double inset = kBodyInset_mm + std::abs(rig.target_bow_mm) +
                       size * std::sin(std::abs(radFromDeg(rig.target_fold_error_deg))) +
                       size * std::abs(rig.print_scale_right - rig.print_scale_down);
  if (nearest < kLeastBody_mm + inset) return {};
  for (Vector3d& point : rim) {
    point = even * (middle + (1.0 - inset / nearest) * (point - middle));
  }
  return convexHull(rim);
}

}  // namespace

void PrintedTarget::addTriangle(const PlacedVertex& a, const PlacedVertex& b, const PlacedVertex& c,
                                int print) {
  const Vector3d ab = b.point_in_table - a.point_in_table;
  const Vector3d ac = c.point_in_table - a.point_in_table;
  const Vector3d scaled = ab.cross(ac);
  if (scaled.norm() < 1e-9) return;
  Facet facet;
  facet.print = print;
  facet.corner = a.point_in_table;
  facet.normal = scaled.normalized();
  facet.at_corner = a.place;
  Eigen::Matrix3d edges;
  edges << ab, ac, facet.normal;
  Eigen::Matrix<double, 2, 3> places;
  places << b.place - a.place, c.place - a.place, Vector2d::Zero();
  facet.place_from_table = places * edges.inverse();
  facets_.push_back(facet);
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  const auto white = static_cast<std::uint8_t>(std::lround(255.0F * kPaper));
  for (const PlacedVertex* vertex : {&a, &b, &c}) {
    MeshVertex& added = mesh_.vertices.emplace_back();
    added.position = vertex->point_in_table;
    added.normal = facet.normal;
    added.rgb = {white, white, white};
  }
  mesh_.triangles.push_back({first, first + 1, first + 2});
}

Result<std::shared_ptr<const PrintedTarget>> PrintedTarget::make(const Target& target,
                                                                 const RigSettings& rig) {
  GYRE_CHECK(rig.validate().ok());
  auto sheets = sheetsOf(target);
  if (!sheets) return sheets.error();
  const Rigid3 table_from_target = tableFromTarget(rig);
  std::shared_ptr<PrintedTarget> printed(new PrintedTarget());
  printed->truth_ = trueTarget(target, *sheets, rig);
  for (const TargetSheet& sheet : *sheets) {
    const SheetShape shape(sheet, rig, sheets->size());
    const int print = static_cast<int>(printed->prints_.size());
    printed->prints_.push_back(sheet.print);
    const auto placed = [&](const Vector2d& place) -> PlacedVertex {
      return {place, table_from_target * shape.inTarget(place)};
    };
    for (const auto& piece : sheet.pieces) {
      for (const auto& strip : stripsOf(piece, sheet.face >= 0 && rig.target_bow_mm != 0.0)) {
        // Right and down turn clockwise as seen from outside.
        double area = 0.0;
        for (std::size_t i = 1; i + 1 < strip.size(); ++i) {
          const Vector2d u = strip[i] - strip[0];
          const Vector2d v = strip[i + 1] - strip[0];
          area += u.x() * v.y() - u.y() * v.x();
        }
        for (std::size_t i = 1; i + 1 < strip.size(); ++i) {
          const std::size_t second = area < 0.0 ? i : i + 1;
          const std::size_t third = area < 0.0 ? i + 1 : i;
          printed->addTriangle(placed(strip[0]), placed(strip[second]), placed(strip[third]),
                               print);
        }
      }
    }
  }
  for (const auto& [a, b, c] : bodyOf(*sheets, rig)) {
    const auto bare = [&](const Vector3d& point) -> PlacedVertex {
      return {Vector2d::Zero(), table_from_target * point};
    };
    printed->addTriangle(bare(a), bare(b), bare(c), -1);
  }
  return std::shared_ptr<const PrintedTarget>(std::move(printed));
}

float PrintedTarget::reflectanceAt(std::uint32_t triangle, const Vector3d& point_in_table,
                                   const Vector3d& direction) const {
  const Facet& facet = facets_[triangle];
  if (facet.print < 0 || facet.normal.dot(direction) >= 0.0) return kPaper;
  const Vector2d place = facet.at_corner + facet.place_from_table * (point_in_table - facet.corner);
  const SheetPrint& print = prints_[static_cast<std::size_t>(facet.print)];
  return print.isDark(place.cast<float>()) ? kInk : kPaper;
}

float PrintedTarget::reflectanceOver(std::uint32_t triangle, const PixelRays& rays) const {
  static const std::array<Vector2d, kSamples> kSubPixels = subPixels();
  const Facet& facet = facets_[triangle];
  if (facet.print < 0 || facet.normal.dot(rays.direction) >= 0.0) return kPaper;
  const SheetPrint& print = prints_[static_cast<std::size_t>(facet.print)];
  // A ray o + t d meets the plane at t = n (corner - o) / (n d), so place = base + t (P d): all
  // that depends on the offset is linear in it.
  const double height = facet.normal.dot(facet.corner - rays.origin);
  const Vector2d base = facet.at_corner + facet.place_from_table * (rays.origin - facet.corner);
  const Vector2d across(facet.normal.dot(rays.along_x), facet.normal.dot(rays.along_y));
  Eigen::Matrix2d sideways;
  sideways << facet.place_from_table * rays.along_x, facet.place_from_table * rays.along_y;
  const double slope = facet.normal.dot(rays.direction);
  const Vector2d ahead = facet.place_from_table * rays.direction;
  const auto place_at = [&](const Vector2d& offset_px) -> Eigen::Vector2f {
    const double t = height / (slope + across.dot(offset_px));
    return (base + t * (ahead + sideways * offset_px)).cast<float>();
  };
  const Eigen::Vector2f centre = place_at(Vector2d::Zero());
  float reach = 0.0F;
  for (const Vector2d& corner :
       {Vector2d(-0.5, -0.5), Vector2d(0.5, -0.5), Vector2d(0.5, 0.5), Vector2d(-0.5, 0.5)}) {
    reach = std::max(reach, (place_at(corner) - centre).norm());
  }
  if (print.clearance(centre) > reach) return print.isDark(centre) ? kInk : kPaper;
  int dark = 0;
  for (const Vector2d& offset_px : kSubPixels) dark += print.isDark(place_at(offset_px)) ? 1 : 0;
  const float share = static_cast<float>(dark) / static_cast<float>(kSamples);
  return kPaper + share * (kInk - kPaper);
}

}  // namespace gyre
