// The simulated camera's pictures, and what is truly seen in each of their pixels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/scan/frame.h"
#include "core/sim/objects.h"
#include "core/sim/ray_scene.h"
#include "core/sim/rig.h"
#include "core/sim/sensor.h"
#include "core/sim/stage.h"

namespace gyre {

enum class TableLoad { kEmpty, kObject };

// What the ray through a pixel's centre meets.
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
  // The settings must be valid.
  explicit Renderer(const RigSettings& rig);

  // The picture after so many commanded steps. A function of the rig's settings and the arguments
  // alone, to the bit, whatever the number of threads. Its time, name and view are not set.
  Frame render(std::int64_t steps, TableLoad load) const;

  // Row by row, for tests.
  std::vector<TruePixel> truePixels(std::int64_t steps, TableLoad load) const;

  const RigSettings& rig() const { return rig_; }
  const SimObject& object() const { return object_; }
  const RayScene& scene() const { return scene_; }

 private:
  // Where one ray met the object.
  struct Surfel {
    float depth_mm = 0.0F;  // 0 = it missed
    Eigen::Vector3f point;
    Eigen::Vector3f normal;
    Eigen::Vector3f paint;
  };
  struct View;

  Renderer(const RigSettings& rig, const Calibration& calibration);
  View viewAt(std::int64_t steps) const;
  void traceRow(int y, const View& view, Surfel* row) const;
  Surfel surfelOf(const RayHit& hit, const Eigen::Vector3f& direction, const View& view) const;
  Eigen::Vector3f lightFrom(const Surfel& surfel, const View& view) const;
  void paintObjectRow(int y, const View& view, const std::vector<Surfel>& surfels,
                      LightImage& light) const;
  void supersample(std::size_t pixel, const View& view, float* bgr) const;
  bool onEdge(int x, int y, const std::vector<Surfel>& surfels) const;

  RigSettings rig_;
  SimObject object_;
  RayScene scene_;
  Stage stage_;
  Sensor sensor_;
  Eigen::Vector3d light_in_base_;
  std::vector<std::uint8_t> is_smooth_;       // per triangle: shade with interpolated normals
  std::vector<std::uint8_t> may_see_object_;  // per pixel, at any angle
  std::unique_ptr<const Renderer> bumped_;    // the same rig after a knock; null without one
};

}  // namespace gyre
