// A calibration target on the simulated table: white matte paper with its print.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/mesh.h"
#include "core/scan/target.h"
#include "core/sim/rig.h"
#include "core/sim/sheet_print.h"

namespace gyre {

// The rays through one pixel, in the table frame: direction + dx * along_x + dy * along_y for
// offsets of up to half a pixel.
struct PixelRays {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  Eigen::Vector3d along_x = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_y = Eigen::Vector3d::Zero();
};

// The target as it stands on the platter (tableFromTarget), with the imperfections that the rig's
// settings ask for. Immutable: any thread may ask.
class PrintedTarget {
 public:
  // Fails with a sentence when the target cannot be painted (see sheetsOf). The settings must be
  // valid.
  static Result<std::shared_ptr<const PrintedTarget>> make(const Target& target,
                                                           const RigSettings& rig);

  // In the table frame: its sheets, and a closed body behind them where they enclose one.
  const Mesh& mesh() const { return mesh_; }

  // Where its points truly are, in the target frame.
  const Target& truth() const { return truth_; }

  // Reflectance in [0, 1] of the paper at a point of a triangle, seen along the direction.
  float reflectanceAt(std::uint32_t triangle, const Eigen::Vector3d& point_in_table,
                      const Eigen::Vector3d& direction) const;

  // Its mean over a pixel that the triangle's plane fills.
  float reflectanceOver(std::uint32_t triangle, const PixelRays& rays) const;

 private:
  PrintedTarget() = default;

  // Plane of a triangle, and the places on its sheet: place = at_corner + place_from_table * (x -
  // corner).
  struct Facet {
    std::int32_t print = -1;  // -1: the bare body
    Eigen::Vector3d corner = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    Eigen::Vector2d at_corner = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 2, 3> place_from_table = Eigen::Matrix<double, 2, 3>::Zero();
  };
  struct PlacedVertex {
    Eigen::Vector2d place;
    Eigen::Vector3d point_in_table;
  };

  void addTriangle(const PlacedVertex& a, const PlacedVertex& b, const PlacedVertex& c, int print);

  Mesh mesh_;
  Target truth_;
  std::vector<SheetPrint> prints_;
  std::vector<Facet> facets_;  // one a triangle
};

}  // namespace gyre
