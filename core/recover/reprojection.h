// How far off a sighting is, and how that changes with the point and with the table's angle.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace gyre {

// In normalised picture coordinates; positions in mm, angles in rad.
struct Reprojection {
  Eigen::Vector2d residual;                 // seen minus projected
  Eigen::Matrix<double, 2, 3> by_position;  // d(projected) / d(position in the table)
  Eigen::Vector2d by_angle;                 // d(projected) / d(table angle)
};

// Nothing when the position is not in front of that camera. Inline: it is called a million times a
// second.
inline std::optional<Reprojection> reproject(const Rigid3& cam_from_table,
                                             const Eigen::Vector2d& seen,
                                             const Eigen::Vector3d& position_in_table) {
  const Eigen::Matrix3d& r = cam_from_table.rotation;
  const Eigen::Vector3d p = r * position_in_table + cam_from_table.translation;
  if (!(p.z() > 1e-6)) return std::nullopt;
  const double iz = 1.0 / p.z();
  const Eigen::Vector2d projected = iz * p.head<2>();
  Reprojection at;
  at.residual = seen - projected;
  at.by_position.noalias() = iz * (r.topRows<2>() - projected * r.row(2));
  // A table that turns by d moves the point by d (z x position).
  at.by_angle =
      at.by_position.col(1) * position_in_table.x() - at.by_position.col(0) * position_in_table.y();
  return at;
}

// Without the derivatives by position: all that judging a position takes.
struct Miss {
  Eigen::Vector2d residual;
  Eigen::Vector2d by_angle;
};

inline std::optional<Miss> missOf(const Rigid3& cam_from_table, const Eigen::Vector2d& seen,
                                  const Eigen::Vector3d& position_in_table) {
  const Eigen::Matrix3d& r = cam_from_table.rotation;
  const Eigen::Vector3d p = r * position_in_table + cam_from_table.translation;
  if (!(p.z() > 1e-6)) return std::nullopt;
  const double iz = 1.0 / p.z();
  const Eigen::Vector2d projected = iz * p.head<2>();
  const Eigen::Vector3d p_by_angle =
      r.col(1) * position_in_table.x() - r.col(0) * position_in_table.y();
  return Miss{seen - projected, iz * (p_by_angle.head<2>() - p_by_angle.z() * projected)};
}

}  // namespace gyre
