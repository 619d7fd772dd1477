// The object on the simulated table: its mesh is the truth that scans are measured against.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geometry/rigid3.h"
#include "core/scan/mesh.h"
#include "core/sim/rig.h"
#include "core/sim/solid_texture.h"

namespace gyre {

// An object as it stands on the platter, in the table frame. Any thread may ask.
class SimObject {
 public:
  // The settings must be valid. Takes about 0.2 s; the same settings give the same object. Nothing
  // (an empty mesh) when the object is a calibration target, which is a PrintedTarget.
  explicit SimObject(const RigSettings& rig);

  // Closed, manifold, oriented outward, standing on z = 0, vertices at most 0.5 mm apart for an
  // object of 80 mm; with normals and colours.
  const Mesh& mesh() const { return mesh_; }

  // Where the object would stand if it had not been turned (object_roll_deg, object_yaw_deg): two
  // settings that differ in these alone are two ways to lay one and the same object on the table.
  const Rigid3& uprightFromTable() const { return upright_from_table_; }

  // Ground colour without texture at a surface point, RGB in [0, 1].
  Eigen::Vector3f paintAt(const Eigen::Vector3d& point_in_table) const;

  // The ground colour with the texture of that point, RGB in [0, 1].
  Eigen::Vector3f albedo(const Eigen::Vector3f& paint, const Eigen::Vector3f& point_in_table) const;

 private:
  Mesh mesh_;
  std::function<Eigen::Vector3f(const Eigen::Vector3d&)> paint_of_model_;
  SolidTexture texture_;
  float contrast_ = 1.0F;
  double model_per_mm_ = 1.0;
  Rigid3 upright_from_table_;
  Eigen::Vector3d origin_in_upright_ = Eigen::Vector3d::Zero();  // of the model's frame
};

}  // namespace gyre
