// The simulated camera's pictures, and what is truly seen in each of their pixels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"
#include "core/sim/objects.h"
#include "core/sim/printed_target.h"
#include "core/sim/ray_scene.h"
#include "core/sim/rig.h"
#include "core/sim/sensor.h"
#include "core/sim/stage.h"

namespace gyre {

// A target that lies under the object is stuck to the platter: it stays when the object goes.
enum class TableLoad { kEmpty, kObject };

// What the ray through a pixel's centre meets; a target counts as object.
struct TruePixel {
  enum class Surface : std::uint8_t { kBackground, kPlatter, kObject };
  Surface surface = Surface::kBackground;
  float depth_mm = 0.0F;                                      // along the optical axis; object only
  Eigen::Vector3f point_in_table = Eigen::Vector3f::Zero();   // object only
  Eigen::Vector3f normal_in_table = Eigen::Vector3f::Zero();  // object only
};

// Immutable after construction, which takes about a second at full size: any thread may render.
class Renderer {
 public:
  // The settings must be valid. target: what rig.target names, made with the same settings; it must
  // be given when the object is a target.
  explicit Renderer(const RigSettings& rig, std::shared_ptr<const PrintedTarget> target = nullptr)
      : Renderer(rig, std::move(target), trueCalibration(rig), Eigen::Vector3d::Zero()) {
    if (rig.bump_px == 0.0 && rig.push_mm == 0.0) return;
    bumped_.reset(new Renderer(rig, target_, bumpedCalibration(rig), pushInBase(rig)));
  }

  // The picture after so many commanded steps. A function of the rig's settings and the arguments
  // alone, to the bit, whatever the number of threads. Its time, name and view are not set.
  Frame render(std::int64_t steps, TableLoad load) const;

  // Row by row, for tests.
  std::vector<TruePixel> truePixels(std::int64_t steps, TableLoad load) const;

  const RigSettings& rig() const { return rig_; }
  // The surface of the object, which may be the target, and the same for rays.
  const Mesh& mesh() const { return targetIsObject() ? target_->mesh() : object_.mesh(); }
  const RayScene& scene() const { return targetIsObject() ? target_scene_ : scene_; }
  const SimObject& object() const { return object_; }
  const PrintedTarget* target() const { return target_.get(); }  // null when there is none

 private:
  // Where one ray met the object.
  struct Surfel {
    float depth_mm = 0.0F;  // 0 = it missed
    Eigen::Vector3f point = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f paint = Eigen::Vector3f::Zero();
    std::uint32_t paper = RayHit::kNone;  // triangle of the target; none when it met the object
  };
  struct View;
  // The nearer of what each ray met: the object or the target.
  struct Hits {
    std::array<RayHit, RayPacket::kSize> nearest;
    std::array<bool, RayPacket::kSize> on_paper{};
  };

  Renderer(const RigSettings& rig, std::shared_ptr<const PrintedTarget> target,
           const Calibration& calibration, const Eigen::Vector3d& push_in_base);
  bool targetIsObject() const { return rig_.object == "target"; }
  View viewAt(std::int64_t steps, TableLoad load) const;
  Hits shoot(const RayPacket& rays, const View& view) const;
  void traceRow(int y, const View& view, Surfel* row) const;
  Surfel paperSurfelOf(const RayHit& hit, const Eigen::Vector3f& direction, const View& view) const;
  Surfel surfelOf(const RayHit& hit, const Eigen::Vector3f& direction, const View& view) const;
  PixelRays raysOf(std::size_t pixel, const View& view) const;
  Eigen::Vector3f albedoOf(const Surfel& surfel, const View& view) const;
  Eigen::Vector3f lightFrom(const Surfel& surfel, const Eigen::Vector3f& albedo,
                            const View& view) const;
  void paintObjectRow(int y, const View& view, const std::vector<Surfel>& surfels,
                      LightImage& light) const;
  void supersample(std::size_t pixel, const View& view, float* bgr) const;
  bool onEdge(int x, int y, const std::vector<Surfel>& surfels) const;

  RigSettings rig_;
  SimObject object_;
  std::shared_ptr<const PrintedTarget> target_;
  RayScene scene_;
  RayScene target_scene_;
  Stage stage_;
  Sensor sensor_;
  Eigen::Vector3d light_in_base_;
  std::vector<std::uint8_t>
      is_smooth_;  // per triangle of the object: shade with interpolated normals
  std::vector<std::uint8_t> may_see_object_;  // per pixel, at any angle; or the target
  std::unique_ptr<const Renderer> bumped_;    // the same rig after a knock or a push; null without
};

}  // namespace gyre
