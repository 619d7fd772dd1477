// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/object_extent.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/geometry/turntable_pose.h"
#include "core/track/search_volume.h"
#include "core/track/usable_cylinder.h"

namespace gyre {
namespace {

constexpr int kCells = 64;       // along the width of what the camera can see
constexpr double kGround = 0.5;  // cells: the lowest layer stands on the platter

struct Lattice {
  double cell_mm = 0.0;
  int layers = 0;

  Eigen::Vector3d at(int layer, int row, int column) const {
    constexpr double kMiddle = 0.5 * (kCells - 1);
    return {cell_mm * (column - kMiddle), cell_mm * (row - kMiddle), cell_mm * (layer + kGround)};
  }
};

// What stays of one layer.
struct Layer {
  std::size_t cells = 0;
  std::size_t leaving = 0;
  double reach_mm = 0.0;
  Eigen::Vector2d sum_mm = Eigen::Vector2d::Zero();
};

bool shownOnObject(const CameraModel& camera, const Rigid3& cam_from_table, const cv::Mat& mask,
                   const Eigen::Vector3d& in_table) {
  const auto pixel = camera.project(cam_from_table * in_table);
  if (!pixel || !camera.contains(*pixel)) return false;
  const int column = static_cast<int>(std::lround(pixel->x()));
  const int row = static_cast<int>(std::lround(pixel->y()));
  return mask.at<std::uint8_t>(row, column) != 0;
}

Layer carve(const Calibration& calibration, const std::vector<SeenOutline>& outlines,
            const Lattice& lattice, int layer) {
  std::vector<Rigid3> poses;
  poses.reserve(outlines.size());
  for (const SeenOutline& seen : outlines) {
    poses.push_back(camFromTable(*calibration.cam_from_table, seen.table_angle_rad));
  }
  Layer left;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const Eigen::Vector3d cell = lattice.at(layer, row, column);
      bool stays = true;
      for (std::size_t i = 0; stays && i < poses.size(); ++i) {
        stays = shownOnObject(calibration.camera, poses[i], outlines[i].mask, cell);
      }
      if (!stays) continue;
      const double radius_mm = cell.head<2>().norm();
      ++left.cells;
      left.sum_mm += cell.head<2>();
      left.reach_mm = std::max(left.reach_mm, radius_mm);
      if (!circleStaysInPicture(calibration.camera, *calibration.cam_from_table, radius_mm,
                                cell.z())) {
        ++left.leaving;
      }
    }
  }
  return left;
}

}  // namespace

std::optional<ObjectExtent> objectExtent(const Calibration& calibration,
                                         const std::vector<SeenOutline>& outlines) {
  GYRE_CHECK(calibration.cam_from_table.has_value());
  if (outlines.empty()) return std::nullopt;
  const SearchVolume volume = visibleVolume(calibration.camera, *calibration.cam_from_table);
  Lattice lattice;
  lattice.cell_mm = 2.0 * volume.radius_mm / kCells;
  if (!(lattice.cell_mm > 0.0)) return std::nullopt;
  lattice.layers = static_cast<int>(std::ceil(volume.z_max_mm / lattice.cell_mm));
  std::vector<Layer> layers(static_cast<std::size_t>(lattice.layers));
  parallelFor(layers.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      layers[i] = carve(calibration, outlines, lattice, static_cast<int>(i));
    }
  });
  Layer all;
  ObjectExtent extent;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].cells == 0) continue;
    all.cells += layers[i].cells;
    all.leaving += layers[i].leaving;
    all.sum_mm += layers[i].sum_mm;
    extent.reach_mm = std::max(extent.reach_mm, layers[i].reach_mm);
    extent.height_mm = lattice.cell_mm * static_cast<double>(i + 1);
  }
  if (all.cells == 0) return std::nullopt;
  const auto cells = static_cast<double>(all.cells);
  extent.off_axis_mm = all.sum_mm.norm() / cells;
  extent.leaving_share = static_cast<double>(all.leaving) / cells;
  return extent;
}

}  // namespace gyre
