// A mesh that rays can be shot at.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "core/scan/mesh.h"

namespace gyre {

// Eight rays from one origin, traced together: neighbours take the same way through the tree.
struct RayPacket {
  static constexpr std::size_t kSize = 8;
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  std::array<Eigen::Vector3f, kSize> direction;  // need not be of unit length
  std::array<bool, kSize> valid{};
};

struct RayHit {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::uint32_t triangle = kNone;
  float distance = 0.0F;  // in lengths of the direction
  float u = 0.0F;         // weight of the triangle's second corner
  float v = 0.0F;         // and of its third
};

// Immutable: any thread may shoot.
class RayScene {
 public:
  explicit RayScene(const Mesh& mesh);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // The nearest hit of every valid ray.
  std::array<RayHit, RayPacket::kSize> closest(const RayPacket& rays) const;

  // True when the mesh stands between the two points, ends excluded by clearance_mm.
  bool occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double clearance_mm) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyre
