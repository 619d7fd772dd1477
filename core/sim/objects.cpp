// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/objects.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/sim/object_models.h"

namespace gyre {
namespace {

constexpr std::uint64_t kTextureUse = 11;
constexpr double kCellOfSize = 0.42 / 80.0;  // lattice cell as a part of the object's diagonal

// A cube of side 1 on z = 0 with n squares an edge; faces share the vertices of their edges.
Mesh cubeMesh(int n) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> index_of;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] =
        index_of.emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.emplace_back().position =
          Eigen::Vector3d(at[0], at[1], at[2]) / n - Eigen::Vector3d(0.5, 0.5, 0.0);
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + di;
            at[(axis + 2) % 3] = j + dj;
            return vertex(at);
          };
          std::array<std::uint32_t, 4> quad = {corner(0, 0), corner(1, 0), corner(1, 1),
                                               corner(0, 1)};
          if (side == 0) std::reverse(quad.begin(), quad.end());
          mesh.triangles.push_back({quad[0], quad[1], quad[2]});
          mesh.triangles.push_back({quad[0], quad[2], quad[3]});
        }
      }
    }
  }
  computeNormals(mesh);
  return mesh;
}

Mesh modelMesh(const ObjectModel& model) {
  if (!model.distance) return cubeMesh(96);
  // The box is a little larger than the object, so cells get finer, never coarser, than wanted.
  const Mesh rough = meshOfImplicit(model.distance, model.box, model.box.diagonal() * 0.02);
  return meshOfImplicit(model.distance, model.box, boundsOf(rough).diagonal() * kCellOfSize);
}

// Turns the object that stands upright as the settings say, and sets it down about the same place.
// Gives upright_from_table: exactly nothing where nothing is turned.
Rigid3 lay(Mesh& mesh, const RigSettings& rig) {
  Rigid3 table_from_upright;
  if (rig.object_roll_deg == 0.0 && rig.object_yaw_deg == 0.0) return table_from_upright;
  table_from_upright.rotation =
      (Eigen::AngleAxisd(radFromDeg(rig.object_yaw_deg), Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(radFromDeg(rig.object_roll_deg), Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.position = table_from_upright.rotation * vertex.position;
    vertex.normal = table_from_upright.rotation * vertex.normal;
  }
  const Bounds bounds = boundsOf(mesh);
  const Eigen::Vector3d middle = 0.5 * (bounds.min + bounds.max);
  const Eigen::Vector2d place = objectOffsetInTable(rig) - middle.head<2>();
  table_from_upright.translation = {place.x(), place.y(), -bounds.min.z()};
  for (MeshVertex& vertex : mesh.vertices) vertex.position += table_from_upright.translation;
  return table_from_upright.inverse();
}

// In [-1, 1], steep in the middle: strong contrast without clipping.
float softClip(float x) { return x / std::sqrt(1.0F + x * x); }

}  // namespace

SimObject::SimObject(const RigSettings& rig)
    : texture_(hashWords({static_cast<std::uint64_t>(rig.seed), kTextureUse}),
               rig.texture_finest_mm, std::max(11.0, 2.0 * rig.texture_finest_mm)) {
  GYRE_CHECK(rig.validate().ok());
  if (rig.object == "target") return;
  const ObjectModel model = objectModel(rig.object);
  paint_of_model_ = model.paint;
  contrast_ = static_cast<float>(rig.texture_contrast * model.texture);
  mesh_ = modelMesh(model);

  const Bounds bounds = boundsOf(mesh_);
  const double mm_per_model = rig.object_size_mm / bounds.diagonal();
  model_per_mm_ = 1.0 / mm_per_model;
  Eigen::Vector3d foot = 0.5 * (bounds.min + bounds.max);
  foot.z() = bounds.min.z();
  origin_in_upright_ = -mm_per_model * foot;
  origin_in_upright_.head<2>() += objectOffsetInTable(rig);
  for (MeshVertex& vertex : mesh_.vertices) {
    vertex.position = mm_per_model * vertex.position + origin_in_upright_;
  }
  upright_from_table_ = lay(mesh_, rig);
  parallelFor(mesh_.vertices.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      MeshVertex& vertex = mesh_.vertices[i];
      const Eigen::Vector3f rgb =
          255.0F * albedo(paintAt(vertex.position), vertex.position.cast<float>());
      for (std::size_t channel = 0; channel < 3; ++channel) {
        vertex.rgb[channel] =
            static_cast<std::uint8_t>(std::lround(rgb[static_cast<Eigen::Index>(channel)]));
      }
    }
  });
}

Eigen::Vector3f SimObject::paintAt(const Eigen::Vector3d& point_in_table) const {
  return paint_of_model_(model_per_mm_ *
                         (upright_from_table_ * point_in_table - origin_in_upright_));
}

Eigen::Vector3f SimObject::albedo(const Eigen::Vector3f& paint,
                                  const Eigen::Vector3f& point_in_table) const {
  const Eigen::Vector3f point_in_upright =
      (upright_from_table_ * point_in_table.cast<double>()).cast<float>();
  const Eigen::Array4f noise = contrast_ * texture_.at(point_in_upright);
  const float bright = 0.66F + 0.34F * softClip(1.2F * noise[0]);
  const Eigen::Array3f tint(softClip(noise[1]), softClip(noise[2]), softClip(noise[3]));
  return (paint.array() * bright + 0.1F * tint).max(0.02F).min(1.0F).matrix();
}

}  // namespace gyre
