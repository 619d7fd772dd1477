// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/truth.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {
namespace {

constexpr double kClearance_mm = 0.02;  // a ray must not meet the very surface it starts from

struct ViewPose {
  Rigid3 cam_from_table;
  Eigen::Vector3d camera_in_table;
};

std::vector<ViewPose> posesOf(const RigSettings& rig, const Rigid3& cam_from_table_at_zero,
                              std::span<const std::int64_t> steps_of_views) {
  std::vector<ViewPose> poses;
  for (const std::int64_t steps : steps_of_views) {
    const Rigid3 cam_from_table = camFromTable(cam_from_table_at_zero, trueAngleRad(rig, steps));
    poses.push_back({cam_from_table, cam_from_table.inverse().translation});
  }
  return poses;
}

// The platter is a disc at z = 0, seen from above or from below.
bool platterHides(const Eigen::Vector3d& point, const Eigen::Vector3d& camera, double radius_mm) {
  if (camera.z() >= 0.0) return false;  // all of the object stands above it
  const double t = point.z() / (point.z() - camera.z());
  return (point + t * (camera - point)).head<2>().norm() <= radius_mm;
}

bool sees(const ViewPose& view, const MeshVertex& vertex, const CameraModel& camera) {
  const Eigen::Vector3d to_camera = view.camera_in_table - vertex.position;
  static const double kLeastCosine = std::cos(radFromDeg(kSteepestView_deg));
  if (vertex.normal.dot(to_camera) < kLeastCosine * to_camera.norm()) return false;
  const auto pixel = camera.project(view.cam_from_table * vertex.position);
  return pixel && camera.contains(*pixel);
}

}  // namespace

Result<Truth> truthOf(const Renderer& renderer, std::span<const std::int64_t> steps_of_views,
                      const Task& task) {
  const RigSettings& rig = renderer.rig();
  const Calibration calibration = trueCalibration(rig);
  const std::vector<ViewPose> poses = posesOf(rig, *calibration.cam_from_table, steps_of_views);
  Truth truth;
  truth.mesh = renderer.mesh();
  truth.size_mm = boundsOf(truth.mesh).diagonal();
  parallelFor(truth.mesh.vertices.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !task.stopRequested(); ++i) {
      MeshVertex& vertex = truth.mesh.vertices[i];
      const Eigen::Vector3d outside = vertex.position + kClearance_mm * vertex.normal;
      int views = 0;
      for (const ViewPose& view : poses) {
        if (sees(view, vertex, calibration.camera) &&
            !platterHides(outside, view.camera_in_table, rig.platter_radius_mm) &&
            !renderer.scene().occluded(outside, view.camera_in_table, kClearance_mm)) {
          ++views;
        }
      }
      vertex.views = static_cast<std::uint16_t>(views);
      vertex.seen = views >= kViewsToBeSeen ? 1 : 0;
    }
  });
  if (task.stopRequested()) return cancelled();
  return truth;
}

double seenShare(const Mesh& truth) {
  double all = 0.0;
  double seen = 0.0;
  for (const auto& [a, b, c] : truth.triangles) {
    const auto& va = truth.vertices[a];
    const auto& vb = truth.vertices[b];
    const auto& vc = truth.vertices[c];
    const double area = (vb.position - va.position).cross(vc.position - va.position).norm();
    all += area;
    if (va.seen != 0 && vb.seen != 0 && vc.seen != 0) seen += area;
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace gyre
