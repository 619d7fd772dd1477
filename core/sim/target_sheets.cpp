// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/target_sheets.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "core/scan/marker_dictionary.h"
#include "core/sim/polygon_clip.h"
#include "core/sim/square_lattice.h"

namespace gyre {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInPlane_mm = 0.05;
constexpr double kRimOfSquare = 0.5;

Error notPaintable(const std::string& problem) {
  return {Error::Code::kInvalidInput, "The simulated rig cannot show this target: " + problem + ".",
          "Give a target whose faces are lattices of squares, as checkerboards are."};
}

bool inPlane(const TargetSheet& sheet, const Vector3d& point) {
  return std::abs(sheet.outward().dot(point - sheet.middle)) <= kInPlane_mm;
}

// The way out of the face: off its markers' printed side, else away from the rest of the target.
Vector3d outwardOf(const std::vector<TargetPoint>& points, const std::vector<std::size_t>& members,
                   const Vector3d& normal) {
  Vector3d middle = Vector3d::Zero();
  for (const std::size_t i : members) middle += points[i].position_in_target;
  middle /= static_cast<double>(members.size());
  double sign = 0.0;
  for (const TargetPoint& point : points) sign += normal.dot(middle - point.position_in_target);
  if (std::abs(sign) < 1e-6 * static_cast<double>(points.size())) sign = normal.z();
  for (std::size_t k = 0; k + 3 < members.size(); ++k) {
    const TargetPoint& first = points[members[k]];
    if (first.marker_id < 0) continue;
    const Vector3d& corner = first.position_in_target;
    sign = normal.dot((points[members[k + 3]].position_in_target - corner)
                          .cross(points[members[k + 1]].position_in_target - corner));
    break;
  }
  return sign < 0.0 ? Vector3d(-normal) : normal;
}

// The frame of a face: along the page where that is known, else along its first corners.
TargetSheet frameOf(const Target& target, int face, const std::vector<TargetPoint>& points) {
  TargetSheet sheet;
  sheet.face = face;
  std::vector<std::size_t> members;
  sheet.middle.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].face != face) continue;
    members.push_back(i);
    sheet.middle += points[i].position_in_target;
  }
  sheet.middle /= static_cast<double>(members.size());
  const auto index = static_cast<std::size_t>(face);
  if (index < target.page_axes.size()) {
    sheet.has_page_axes = true;
    sheet.right = target.page_axes[index].right_in_target.normalized();
    sheet.down = target.page_axes[index].down_in_target;
    sheet.down = (sheet.down - sheet.right.dot(sheet.down) * sheet.right).normalized();
    return sheet;
  }
  const Vector3d& first = points[members[0]].position_in_target;
  const Vector3d along = (points[members[1]].position_in_target - first).normalized();
  Vector3d normal = Vector3d::Zero();
  for (const std::size_t i : members) {
    const Vector3d candidate = along.cross(points[i].position_in_target - first);
    if (candidate.norm() > normal.norm()) normal = candidate;
  }
  const Vector3d outward = outwardOf(points, members, normal.normalized());
  sheet.right = along;
  sheet.down = along.cross(outward).normalized();
  return sheet;
}

SheetCode codeOf(const TargetSheet& sheet, const TargetMarker& marker,
                 const MarkerDictionary& dictionary) {
  SheetCode code;
  code.modules_a_side = dictionary.modules_a_side();
  code.modules = markerModules(dictionary, marker.id);
  code.origin = sheet.placeOf(marker.corners_in_target[0]);
  code.module.col(0) = sheet.placeOf(marker.corners_in_target[1]) - code.origin;
  code.module.col(1) = sheet.placeOf(marker.corners_in_target[3]) - code.origin;
  code.module /= code.modules_a_side;
  return code;
}

std::vector<const TargetMarker*> markersOn(const Target& target,
                                           const std::vector<TargetPoint>& points, int face) {
  std::vector<const TargetMarker*> markers;
  for (std::size_t i = 0; i < target.markers.size(); ++i) {
    if (points[target.corners.size() + 4 * i].face == face) markers.push_back(&target.markers[i]);
  }
  return markers;
}

// Squares that hold a code are bright; without codes, the first corner tells (see target.h).
int darkParity(const LatticeFit& fit, const std::vector<SheetCode>& codes) {
  if (codes.empty()) {
    const Eigen::Array2i towards_last =
        (fit.index.back() >= fit.index.front()).select(Eigen::Array2i::Zero(), -1);
    return (fit.index.front() + towards_last).sum() & 1;
  }
  int odd = 0;
  const Eigen::Matrix2d cells_from_mm = fit.step.inverse();
  for (const SheetCode& code : codes) {
    const Vector2d centre =
        code.origin + code.module * Vector2d::Constant(0.5 * code.modules_a_side);
    const Eigen::Array2i square =
        (cells_from_mm * (centre - fit.origin)).array().floor().cast<int>();
    odd += (square.sum() & 1) != 0 ? 1 : -1;
  }
  return odd > 0 ? 0 : 1;
}

// Where another face or the table begins, the paper ends, unless the corners' own squares lie on
// both sides there.
void cutPieces(const std::vector<TargetSheet>& sheets, const std::vector<Vector2d>& squares,
               TargetSheet& sheet) {
  const auto cut = [&](const Vector3d& normal, double most) {
    // normal . x <= most for the rest, as a half-plane of the sheet.
    const HalfPlane half{{normal.dot(sheet.right), normal.dot(sheet.down)},
                         most - normal.dot(sheet.middle)};
    const bool keeps_squares = std::all_of(squares.begin(), squares.end(), [&](const Vector2d& at) {
      return half.normal.dot(at) <= half.most + 1e-9;
    });
    if (!keeps_squares) return;
    for (auto& piece : sheet.pieces) piece = clipped(piece, half);
  };
  cut(-Vector3d::UnitZ(), 0.0);
  for (const TargetSheet& other : sheets) {
    if (other.face >= 0 && other.face != sheet.face) {
      cut(other.outward(), other.outward().dot(other.middle));
    }
  }
}

Result<std::vector<Vector2d>> printFace(const Target& target,
                                        const std::vector<TargetPoint>& points,
                                        TargetSheet& sheet) {
  std::vector<Vector2d> corners;
  for (const int id : target.faces[static_cast<std::size_t>(sheet.face)]) {
    const auto corner = std::find_if(target.corners.begin(), target.corners.end(),
                                     [&](const TargetCorner& each) { return each.id == id; });
    if (corner != target.corners.end()) {
      corners.push_back(sheet.placeOf(corner->position_in_target));
    }
  }
  const auto fit = fitLattice(corners);
  if (!fit) {
    return notPaintable("the corners of face " + std::to_string(sheet.face + 1) +
                        " are not evenly spaced in two directions");
  }
  std::vector<SheetCode> codes;
  const auto dictionary = markerDictionary(target.dictionary);
  for (const TargetMarker* marker : markersOn(target, points, sheet.face)) {
    if (!dictionary || marker->id < 0 || marker->id >= dictionary->markers) {
      return notPaintable("it has a marker that is in no known dictionary");
    }
    codes.push_back(codeOf(sheet, *marker, *dictionary));
  }
  SquareLattice lattice{fit->origin, fit->step, fit->index[0], fit->index[0],
                        darkParity(*fit, codes)};
  for (const Eigen::Array2i& index : fit->index) {
    lattice.first = lattice.first.min(index);
    lattice.last = lattice.last.max(index);
  }
  lattice.first -= 1;
  const auto outline = [&](double rim) {
    const Eigen::Array2d low = lattice.first.cast<double>() - rim;
    const Eigen::Array2d high = lattice.last.cast<double>() + 1.0 + rim;
    std::vector<Vector2d> around;
    for (const Vector2d& cell : {Vector2d(low.x(), low.y()), Vector2d(high.x(), low.y()),
                                 Vector2d(high.x(), high.y()), Vector2d(low.x(), high.y())}) {
      around.emplace_back(fit->origin + fit->step * cell);
    }
    return around;
  };
  sheet.pieces = {outline(kRimOfSquare)};
  Vector2d half_size = Vector2d::Zero();
  for (const Vector2d& at : sheet.pieces[0]) half_size = half_size.cwiseMax(at.cwiseAbs());
  sheet.print = SheetPrint(half_size);
  sheet.print.set(lattice);
  for (const SheetCode& code : codes) sheet.print.add(code);
  for (const TargetDot& dot : target.dots) {
    const Vector2d place = sheet.placeOf(dot.centre_in_target);
    if (inPlane(sheet, dot.centre_in_target) &&
        (place.cwiseAbs().array() < half_size.array()).all())
      sheet.print.add(SheetDot{place, 0.5 * dot.diameter_mm});
  }
  return outline(0.0);
}

// Markers of no face, those of one plane together, each on a patch of its own.
std::vector<TargetSheet> patchesOf(const std::vector<const TargetMarker*>& markers,
                                   const MarkerDictionary& dictionary) {
  std::vector<TargetSheet> sheets;
  std::vector<std::vector<const TargetMarker*>> members;
  for (const TargetMarker* marker : markers) {
    const auto& at = marker->corners_in_target;
    TargetSheet own;
    own.right = (at[1] - at[0]).normalized();
    own.down = (at[3] - at[0]).normalized();
    own.middle = Vector3d(0.5 * (at[0] + at[2]));
    std::size_t i = 0;
    while (i < sheets.size() &&
           !(own.outward().dot(sheets[i].outward()) > 0.9999 && inPlane(sheets[i], own.middle)))
      ++i;
    if (i == sheets.size()) {
      sheets.push_back(own);
      members.emplace_back();
    }
    members[i].push_back(marker);
  }
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    TargetSheet& sheet = sheets[i];
    std::vector<SheetCode> codes;
    Vector2d half_size = Vector2d::Zero();
    for (const TargetMarker* marker : members[i]) {
      const SheetCode& code = codes.emplace_back(codeOf(sheet, *marker, dictionary));
      const double far = code.modules_a_side + 1.0;
      std::vector<Vector2d>& piece = sheet.pieces.emplace_back();
      for (const Vector2d& module :
           {Vector2d(-1, -1), Vector2d(far, -1), Vector2d(far, far), Vector2d(-1, far)}) {
        piece.emplace_back(code.origin + code.module * module);
        half_size = half_size.cwiseMax(piece.back().cwiseAbs());
      }
    }
    sheet.print = SheetPrint(half_size);
    for (const SheetCode& code : codes) sheet.print.add(code);
  }
  return sheets;
}

}  // namespace

Result<std::vector<TargetSheet>> sheetsOf(const Target& target) {
  const std::vector<TargetPoint> points = pointsOf(target);
  for (const TargetPoint& point : points) {
    if (point.face < 0 && point.corner_id >= 0) {
      return notPaintable("the corner " + std::to_string(point.corner_id) + " is on no face");
    }
  }
  std::vector<TargetSheet> sheets;
  std::vector<std::vector<Vector2d>> squares;
  for (std::size_t face = 0; face < target.faces.size(); ++face) {
    if (target.faces[face].size() < 3) return notPaintable("a face has less than three corners");
    sheets.push_back(frameOf(target, static_cast<int>(face), points));
    auto printed = printFace(target, points, sheets.back());
    if (!printed) return printed.error();
    squares.push_back(std::move(printed).value());
  }
  for (std::size_t i = 0; i < sheets.size(); ++i) cutPieces(sheets, squares[i], sheets[i]);
  const auto loose = markersOn(target, points, -1);
  if (!loose.empty()) {
    const auto dictionary = markerDictionary(target.dictionary);
    const bool known = dictionary && std::all_of(loose.begin(), loose.end(), [&](const auto* each) {
                         return each->id >= 0 && each->id < dictionary->markers;
                       });
    if (!known) return notPaintable("it has a marker that is in no known dictionary");
    for (TargetSheet& patch : patchesOf(loose, *dictionary)) sheets.push_back(std::move(patch));
  }
  if (sheets.empty()) return notPaintable("it has no points");
  return sheets;
}

}  // namespace gyre
