// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ray_scene.h"

#include <cmath>
#include <limits>
#include <span>

#include <embree3/rtcore.h>

#include "core/base/check.h"

namespace gyre {

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

namespace {

void addMesh(RTCDevice device, RTCScene scene, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t vertex_count = mesh.vertices.size();
  const std::size_t triangle_count = mesh.triangles.size();
  auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangle_count));
  const std::span<float> corner_span(corners, 3 * vertex_count);
  const std::span<std::uint32_t> index_span(indices, 3 * triangle_count);
  for (std::size_t i = 0; i < 3 * vertex_count; ++i) {
    corner_span[i] =
        static_cast<float>(mesh.vertices[i / 3].position[static_cast<Eigen::Index>(i % 3)]);
  }
  for (std::size_t i = 0; i < 3 * triangle_count; ++i) {
    index_span[i] = mesh.triangles[i / 3][i % 3];
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

RayScene::RayScene(const Mesh& mesh) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  GYRE_CHECK(impl_->device != nullptr);
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);  // no rays slip through shared edges
  if (!mesh.triangles.empty()) addMesh(impl_->device, impl_->scene, mesh);
  rtcCommitScene(impl_->scene);
}

RayScene::~RayScene() {
  rtcReleaseScene(impl_->scene);
  rtcReleaseDevice(impl_->device);
}

std::array<RayHit, RayPacket::kSize> RayScene::closest(const RayPacket& rays) const {
  alignas(32) std::array<int, RayPacket::kSize> valid{};
  RTCRayHit8 query{};
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    valid[i] = rays.valid[i] ? -1 : 0;
    query.ray.org_x[i] = rays.origin.x();
    query.ray.org_y[i] = rays.origin.y();
    query.ray.org_z[i] = rays.origin.z();
    query.ray.dir_x[i] = rays.direction[i].x();
    query.ray.dir_y[i] = rays.direction[i].y();
    query.ray.dir_z[i] = rays.direction[i].z();
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.mask[i] = 0xffffffffU;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), impl_->scene, &context, &query);
  std::array<RayHit, RayPacket::kSize> hits;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    if (!rays.valid[i] || query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i] = {query.hit.primID[i], query.ray.tfar[i], query.hit.u[i], query.hit.v[i]};
  }
  return hits;
}

bool RayScene::occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        double clearance_mm) const {
  const Eigen::Vector3f direction = (to - from).cast<float>();
  const float length = direction.norm();
  const auto clearance = static_cast<float>(clearance_mm) / length;
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = clearance;
  ray.tfar = 1.0F - clearance;
  ray.mask = 0xffffffffU;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar < 0.0F;  // Embree's sign for "something was hit"
}

}  // namespace gyre
