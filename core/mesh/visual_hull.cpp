// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/visual_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/geometry/distance_lattice.h"
#include "core/mesh/components.h"
#include "core/mesh/depth_map.h"
#include "core/mesh/marching_tetrahedra.h"
#include "core/scan/silhouette.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastOutlines = 3;
constexpr double kCellsAcross = 128.0;  // along the diagonal of the object's box, by default
constexpr double kFindingCells = 48.0;  // along the box in which the object is looked for
constexpr int kFindings = 3;
constexpr double kMendingCells = 80.0;  // along the diagonal, while outlines are mended
// So many times as many outlines are disbelieved while they are mended.
constexpr std::array kMendingTimes = {4.0, 2.0};
constexpr double kNowhere_mm = 1e6;
// A staircase of pixels becomes a line; what is finer than that was not in the outline.
constexpr double kSmoothing_px = 0.8;
// Distances in a picture and in space differ by the slant of the line of sight.
constexpr DistanceStretch kStretch = {.outside = 1.3, .inside = 1.3};

// How far a place lies from the object's outline in one picture.
class OutlineDistance {
 public:
  explicit OutlineDistance(const Outline& outline) : camera_(outline.camera) {
    shrunk_ = shrinkOf(outline.mask, camera_.intrinsics.width_px);
    cv::Mat outside;
    cv::Mat inside;
    cv::distanceTransform(outline.mask == 0, outside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(outline.mask != 0, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    // From pixel centre to pixel centre: the line between them lies half a pixel from either.
    cv::Mat half = cv::Mat::ones(outside.size(), CV_32F) * 0.5F;
    half.setTo(-0.5F, outline.mask == 0);
    distance_px_ = outside - inside + half;
    cv::GaussianBlur(distance_px_, distance_px_, {}, kSmoothing_px);
    // A pixel counts as the object's where any part of it does.
    distance_px_ += 0.5 * (shrunk_ - 1.0) / shrunk_;
  }

  // Of a place in the table frame, in mm there; nothing when the picture does not show it.
  std::optional<double> at(const Eigen::Vector3d& place_in_table) const {
    const Eigen::Vector3d place_in_cam = camera_.cam_from_table * place_in_table;
    const auto pixel = camera_.intrinsics.project(place_in_cam);
    if (!pixel) return std::nullopt;
    const double x = (pixel->x() + 0.5) / shrunk_ - 0.5;
    const double y = (pixel->y() + 0.5) / shrunk_ - 0.5;
    if (x < 0.0 || y < 0.0 || x >= distance_px_.cols - 1 || y >= distance_px_.rows - 1) {
      return std::nullopt;
    }
    const double mm_a_pixel = shrunk_ * place_in_cam.z() / camera_.intrinsics.fx;
    return between(x, y) * mm_a_pixel;
  }

 private:
  double between(double x, double y) const {
    const auto column = static_cast<int>(x);
    const auto row = static_cast<int>(y);
    const double right = x - column;
    const double down = y - row;
    const auto* upper = distance_px_.ptr<float>(row) + column;
    const auto* lower = distance_px_.ptr<float>(row + 1) + column;
    return (1.0 - down) * ((1.0 - right) * upper[0] + right * upper[1]) +
           down * ((1.0 - right) * lower[0] + right * lower[1]);
  }

  PosedCamera camera_;
  double shrunk_ = 1.0;
  cv::Mat distance_px_;  // positive outside, in the mask's pixels
};

// The distance to the hull: the largest of those to the outlines, but for the few not believed.
class HullDistance {
 public:
  HullDistance(const SightEvidence& evidence, double disbelieved_share)
      : disbelieved_(countOf(evidence, disbelieved_share)) {
    std::vector<std::optional<OutlineDistance>> made(evidence.outlines.size());
    parallelFor(made.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        made[i].emplace(evidence.outlines[i]);
      }
    });
    for (auto& each : made) outlines_.push_back(std::move(*each));
  }

  static std::size_t countOf(const SightEvidence& evidence, double share) {
    return static_cast<std::size_t>(
        std::floor(share * static_cast<double>(evidence.outlines.size())));
  }

  double operator()(const Eigen::Vector3d& place) const {
    std::vector<double> distances_mm;
    distances_mm.reserve(outlines_.size());
    for (const OutlineDistance& outline : outlines_) {
      if (const auto distance_mm = outline.at(place)) distances_mm.push_back(*distance_mm);
    }
    // What hardly any picture shows is not where the object was put.
    if (2 * distances_mm.size() < outlines_.size() || distances_mm.size() <= disbelieved_) {
      return kNowhere_mm;
    }
    const auto believed = distances_mm.begin() + static_cast<std::ptrdiff_t>(disbelieved_);
    std::nth_element(distances_mm.begin(), believed, distances_mm.end(), std::greater<>());
    return std::max(*believed, -place.z());
  }

 private:
  std::vector<OutlineDistance> outlines_;
  std::size_t disbelieved_;
};

// Where anything of the object may be: around the axis, within the cameras' distance from it.
Eigen::AlignedBox3d whereItMayBe(const SightEvidence& evidence) {
  double reach_mm = 0.0;
  for (const Outline& outline : evidence.outlines) {
    const Eigen::Vector3d centre = outline.camera.centreInTable();
    reach_mm = std::max(reach_mm, centre.norm());
  }
  return {Eigen::Vector3d(-reach_mm, -reach_mm, 0.0),
          Eigen::Vector3d(reach_mm, reach_mm, reach_mm)};
}

// The box of all lattice points around which a part of the object may be.
Eigen::AlignedBox3d boxOf(const DistanceLattice& lattice) {
  Eigen::AlignedBox3d box;
  const double near_mm = std::sqrt(3.0) * lattice.cell_mm;
  for (int z = 0; z < lattice.size.z(); ++z) {
    for (int y = 0; y < lattice.size.y(); ++y) {
      for (int x = 0; x < lattice.size.x(); ++x) {
        if (lattice.value({x, y, z}) < near_mm) box.extend(lattice.at({x, y, z}));
      }
    }
  }
  if (!box.isEmpty()) box.min().z() = std::max(box.min().z(), 0.0);
  return box;
}

Error leavesNothing() {
  return {Error::Code::kTooFew, "The outlines of the object leave nothing solid between them.",
          "Check that outlines, angles and calibration belong together, and that the object stands "
          "out from its background in every view."};
}

// The box of the object, found coarsely and then finer.
Result<Eigen::AlignedBox3d> findBox(const HullDistance& distance, Eigen::AlignedBox3d box,
                                    const Task& task) {
  for (int round = 0; round < kFindings; ++round) {
    const double cell_mm = box.sizes().maxCoeff() / kFindingCells;
    box = boxOf(sampleDistance(std::cref(distance), box, cell_mm, kStretch, task));
    if (task.stopRequested()) return cancelled();
    if (box.isEmpty() || box.volume() <= 0.0) return leavesNothing();
  }
  return box;
}

// A body that the pictures cut off ends there.
void closeBorder(DistanceLattice& lattice) {
  const Eigen::Array3i last = lattice.size - 1;
  for (int z = 0; z <= last.z(); ++z) {
    for (int y = 0; y <= last.y(); ++y) {
      for (int x = 0; x <= last.x(); ++x) {
        const Eigen::Array3i p(x, y, z);
        if ((p > 0).all() && (p < last).all()) continue;
        float& value = lattice.values[lattice.index(p)];
        value = std::max(value, static_cast<float>(lattice.cell_mm));
      }
    }
  }
}

// Where object and background look alike, an outline has bites, in every view at the same place of
// the picture: so narrow ones are filled.
void closeBites(SightEvidence& evidence, double gap_share) {
  parallelFor(evidence.outlines.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const cv::Mat& mask = evidence.outlines[i].mask;
      const double across_px = std::sqrt(4.0 / kPi * cv::countNonZero(mask));
      const auto radius = static_cast<int>(std::lround(0.5 * gap_share * across_px));
      if (radius == 0) continue;
      const cv::Mat disc =
          cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
      cv::Mat closed;
      cv::morphologyEx(mask, closed, cv::MORPH_CLOSE, disc);
      evidence.outlines[i].mask = closed;
    }
  });
}

// A bite out of one outline would go through the whole body. What is left when more outlines are
// disbelieved is too large, by no more than it bulges between the views where each place is on the
// outline; the rest of it is filled into every outline.
Result<void> mendOutlines(SightEvidence& evidence, double disbelieved_share,
                          const Eigen::AlignedBox3d& box, const Task& task) {
  const std::size_t disbelieved = HullDistance::countOf(evidence, disbelieved_share);
  if (disbelieved == 0) return {};
  const HullDistance distance(evidence, disbelieved_share);
  const double cell_mm = box.diagonal().norm() / kMendingCells;
  auto lattice = sampleDistance(std::cref(distance), box, cell_mm, kStretch, task);
  if (task.stopRequested()) return cancelled();
  closeBorder(lattice);
  const auto views = static_cast<double>(evidence.outlines.size());
  const double half_gap_rad = 0.5 * (static_cast<double>(disbelieved) + 1.0) * kTurn_rad / views;
  const double bulge_mm =
      (1.0 - std::cos(half_gap_rad)) * 0.5 * box.sizes().head<2>().norm() + 0.5 * cell_mm;
  for (float& value : lattice.values) value += static_cast<float>(bulge_mm);
  const Mesh core = marchingTetrahedra(lattice);
  parallelFor(evidence.outlines.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !task.stopRequested(); ++i) {
      Outline& outline = evidence.outlines[i];
      const int shrink =
          static_cast<int>(shrinkOf(outline.mask, outline.camera.intrinsics.width_px));
      const cv::Mat shown =
          depthMap(core, outline.camera, shrink) < std::numeric_limits<float>::max();
      cv::Mat mended = outline.mask.clone();
      const cv::Rect common(
          {}, cv::Size(std::min(shown.cols, mended.cols), std::min(shown.rows, mended.rows)));
      mended(common).setTo(255, shown(common));
      outline.mask = mended;
    }
  });
  return {};
}

// What lies in the table but for rounding lies in it, and nobody saw it.
void markBase(Mesh& mesh, double cell_mm) {
  for (MeshVertex& vertex : mesh.vertices) {
    if (vertex.position.z() >= 1e-3 * cell_mm) continue;
    vertex.position.z() = 0.0;
    vertex.seen = 0;
  }
}

}  // namespace

Result<VisualHullMesh> visualHull(const SightEvidence& evidence, const VisualHullOptions& options,
                                  const Task& task) {
  if (const auto valid = options.validate(); !valid) return valid.error();
  if (evidence.outlines.size() < kLeastOutlines) {
    return Error{Error::Code::kInvalidInput,
                 "A body from outlines needs at least 3 of them, and there are " +
                     std::to_string(evidence.outlines.size()) + ".",
                 "Reconstruct with a picture of the bare table (--background) or with masks, so "
                 "that the object can be told from its background."};
  }
  task.report(0.0, "Looking for the object in its outlines");
  SightEvidence mended;
  mended.outlines = evidence.outlines;
  closeBites(mended, options.gap_share);
  const double most_share = std::min(kMendingTimes.front() * options.disbelieved_share, 0.5);
  const auto box = findBox(HullDistance(mended, most_share), whereItMayBe(evidence), task);
  if (!box) return box.error();
  task.report(0.2, "Mending the outlines");
  for (const double times : kMendingTimes) {
    const double share = std::min(times * options.disbelieved_share, 0.5);
    if (const auto done = mendOutlines(mended, share, *box, task); !done) return done.error();
  }
  const HullDistance distance(mended, options.disbelieved_share);
  VisualHullMesh hull;
  hull.cell_mm = options.cell_mm > 0.0 ? options.cell_mm : box->diagonal().norm() / kCellsAcross;
  task.report(0.3, "Carving the body out of its outlines");
  auto lattice =
      sampleDistance(std::cref(distance), *box, hull.cell_mm, kStretch, task.part(0.3, 0.9));
  if (task.stopRequested()) return cancelled();
  closeBorder(lattice);
  hull.mesh = marchingTetrahedra(lattice);
  if (hull.mesh.triangles.empty()) return leavesNothing();
  removeSmallComponents(hull.mesh, options.min_component_share);
  markBase(hull.mesh, hull.cell_mm);
  task.report(1.0, "Body made of its outlines");
  return hull;
}

}  // namespace gyre
