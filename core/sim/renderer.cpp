// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"

namespace gyre {

// One angle of the table, seen from the table: the object rests and the camera goes round.
struct Renderer::View {
  bool shows_object = false;
  bool shows_target = false;
  double table_angle_rad = 0.0;
  Eigen::Matrix3f table_from_base;
  Eigen::Vector3f camera_in_table;
  Eigen::Vector3f light_in_table;
};

namespace {

constexpr std::uint64_t kFlickerUse = 41;
constexpr std::uint64_t kNoiseUse = 42;
constexpr float kDepthEdge_mm = 1.5F;
constexpr float kNormalEdge = 0.85F;    // cosine between neighbours
constexpr float kSmoothNormal = 0.85F;  // cosine between vertex and face
constexpr int kMostTextureSamples = 4;

// Eight rooks: one sub-pixel sample in each of eight rows and columns.
constexpr std::array<int, 8> kRooks = {2, 5, 0, 7, 3, 6, 1, 4};

std::uint64_t word(TableLoad load) { return load == TableLoad::kObject ? 1 : 0; }

// Triangles whose corners' normals all agree with their own: away from creases.
std::vector<std::uint8_t> smoothTriangles(const Mesh& mesh) {
  std::vector<std::uint8_t> smooth;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& va = mesh.vertices[a];
    const auto& vb = mesh.vertices[b];
    const auto& vc = mesh.vertices[c];
    const Eigen::Vector3d normal =
        (vb.position - va.position).cross(vc.position - va.position).normalized();
    const double worst =
        std::min({normal.dot(va.normal), normal.dot(vb.normal), normal.dot(vc.normal)});
    smooth.push_back(worst > static_cast<double>(kSmoothNormal) ? 1 : 0);
  }
  return smooth;
}

// Marks the pixels whose rays cross the cylinder that the mesh sweeps as it turns.
void markSwept(const Mesh& mesh, const Stage& stage, std::vector<std::uint8_t>& swept) {
  if (mesh.vertices.empty()) return;
  double radius = 0.0;
  double height = 0.0;
  for (const MeshVertex& vertex : mesh.vertices) {
    radius = std::max(radius, vertex.position.head<2>().norm());
    height = std::max(height, vertex.position.z());
  }
  parallelFor(swept.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ray ray{stage.cameraInBase(), stage.direction(i).cast<double>().normalized()};
      const auto span = crossCylinder(ray, radius + 1.0, -1.0, height + 1.0);
      if (span && span->to > 0.0) swept[i] = 1;
    }
  });
}

const Mesh& meshOf(const PrintedTarget* target) {
  static const Mesh kNone;
  return target != nullptr ? target->mesh() : kNone;
}

}  // namespace

Renderer::Renderer(const RigSettings& rig, std::shared_ptr<const PrintedTarget> target,
                   const Calibration& calibration, const Eigen::Vector3d& push_in_base)
    : rig_(rig),
      object_(rig),
      target_(std::move(target)),
      scene_(object_.mesh()),
      target_scene_(meshOf(target_.get())),
      stage_(rig, calibration, push_in_base),
      sensor_(rig.blur_sigma_px, rig.noise_sigma, rig.exposure_gain),
      light_in_base_(keyLightInBase(rig)),
      is_smooth_(smoothTriangles(object_.mesh())),
      may_see_object_(static_cast<std::size_t>(rig.image_width_px) *
                      static_cast<std::size_t>(rig.image_height_px)) {
  GYRE_CHECK(target_ != nullptr || !targetIsObject());
  markSwept(object_.mesh(), stage_, may_see_object_);
  markSwept(meshOf(target_.get()), stage_, may_see_object_);
}

Renderer::View Renderer::viewAt(std::int64_t steps, TableLoad load) const {
  View view;
  view.shows_object = load == TableLoad::kObject && !targetIsObject();
  view.shows_target = target_ != nullptr && (load == TableLoad::kObject || !targetIsObject());
  view.table_angle_rad = trueAngleRad(rig_, steps);
  const Eigen::Matrix3d table_from_base = baseFromTable(view.table_angle_rad).rotation.transpose();
  view.table_from_base = table_from_base.cast<float>();
  view.camera_in_table = (table_from_base * stage_.cameraInBase()).cast<float>();
  view.light_in_table = (table_from_base * light_in_base_).cast<float>();
  return view;
}

Renderer::Hits Renderer::shoot(const RayPacket& rays, const View& view) const {
  Hits hits;
  if (view.shows_object) hits.nearest = scene_.closest(rays);
  if (!view.shows_target) return hits;
  const auto on_target = target_scene_.closest(rays);
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    RayHit& nearest = hits.nearest[i];
    if (on_target[i].triangle == RayHit::kNone) continue;
    if (nearest.triangle != RayHit::kNone && nearest.distance <= on_target[i].distance) continue;
    nearest = on_target[i];
    hits.on_paper[i] = true;
  }
  return hits;
}

// Paper is flat: the facet's own normal, turned to the side that is seen.
Renderer::Surfel Renderer::paperSurfelOf(const RayHit& hit, const Eigen::Vector3f& direction,
                                         const View& view) const {
  const Mesh& mesh = target_->mesh();
  const MeshVertex& corner = mesh.vertices[mesh.triangles[hit.triangle][0]];
  const Eigen::Vector3d ray = (view.table_from_base * direction).cast<double>();
  const Eigen::Vector3d origin = view.camera_in_table.cast<double>();
  const double slope = corner.normal.dot(ray);
  const double depth = std::abs(slope) > 1e-6 ? corner.normal.dot(corner.position - origin) / slope
                                              : static_cast<double>(hit.distance);
  Surfel surfel;
  surfel.depth_mm = static_cast<float>(depth);
  surfel.point = (origin + depth * ray).cast<float>();
  surfel.normal = (slope > 0.0 ? -1.0F : 1.0F) * corner.normal.cast<float>();
  surfel.paint = Eigen::Vector3f::Ones();
  surfel.paper = hit.triangle;
  return surfel;
}

Renderer::Surfel Renderer::surfelOf(const RayHit& hit, const Eigen::Vector3f& direction,
                                    const View& view) const {
  Surfel surfel;
  const Mesh& mesh = object_.mesh();
  const auto& [a, b, c] = mesh.triangles[hit.triangle];
  const MeshVertex& va = mesh.vertices[a];
  const MeshVertex& vb = mesh.vertices[b];
  const MeshVertex& vc = mesh.vertices[c];
  // The hit again in double precision: near the rim Embree's own is off the ray by hundredths of
  // a pixel.
  const Eigen::Vector3d face = (vb.position - va.position).cross(vc.position - va.position);
  const Eigen::Vector3d origin = view.camera_in_table.cast<double>();
  const Eigen::Vector3d ray = (view.table_from_base * direction).cast<double>();
  const double slope = face.dot(ray);
  const double depth = std::abs(slope) > 1e-4 * face.norm() * ray.norm()
                           ? face.dot(va.position - origin) / slope
                           : static_cast<double>(hit.distance);
  const Eigen::Vector3d point = origin + depth * ray;
  surfel.depth_mm = static_cast<float>(depth);  // directions are unit along the optical axis
  surfel.point = point.cast<float>();
  const auto u = static_cast<double>(hit.u);
  const auto v = static_cast<double>(hit.v);
  const Eigen::Vector3d normal =
      is_smooth_[hit.triangle] != 0
          ? Eigen::Vector3d((1.0 - u - v) * va.normal + u * vb.normal + v * vc.normal)
          : face;
  surfel.normal = normal.normalized().cast<float>();
  // An interpolated normal may look away at the very rim.
  const Eigen::Vector3f to_camera = -(view.table_from_base * direction).normalized();
  const float facing = surfel.normal.dot(to_camera);
  if (facing < 0.0F) surfel.normal = (surfel.normal - 1.01F * facing * to_camera).normalized();
  surfel.paint = object_.paintAt(point);
  return surfel;
}

void Renderer::traceRow(int y, const View& view, Surfel* row) const {
  const int width = rig_.image_width_px;
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  RayPacket rays;
  rays.origin = view.camera_in_table;
  for (int x = 0; x < width; x += static_cast<int>(RayPacket::kSize)) {
    bool any = false;
    for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
      const std::size_t column = static_cast<std::size_t>(x) + i;
      rays.valid[i] =
          column < static_cast<std::size_t>(width) && may_see_object_[first + column] != 0;
      any = any || rays.valid[i];
      rays.direction[i] =
          rays.valid[i] ? Eigen::Vector3f(view.table_from_base * stage_.direction(first + column))
                        : Eigen::Vector3f::UnitX();
    }
    if (!any) continue;
    const Hits hits = shoot(rays, view);
    for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
      if (hits.nearest[i].triangle == RayHit::kNone) continue;
      const std::size_t column = static_cast<std::size_t>(x) + i;
      const Eigen::Vector3f& direction = stage_.direction(first + column);
      row[column] = hits.on_paper[i] ? paperSurfelOf(hits.nearest[i], direction, view)
                                     : surfelOf(hits.nearest[i], direction, view);
    }
  }
}

Eigen::Vector3f Renderer::albedoOf(const Surfel& surfel, const View& view) const {
  if (surfel.paper != RayHit::kNone) {
    const Eigen::Vector3d point = surfel.point.cast<double>();
    return Eigen::Vector3f::Constant(
        target_->reflectanceAt(surfel.paper, point, point - view.camera_in_table.cast<double>()));
  }
  const Eigen::Vector3f to_camera = (view.camera_in_table - surfel.point).normalized();
  const float facing = std::max(surfel.normal.dot(to_camera), 1e-3F);
  // A pixel covers a strip of the surface that is 1 / facing times as long as it is wide. Where
  // that matters the texture is averaged along the strip, as the light is on a real sensor.
  const int samples =
      std::clamp(static_cast<int>(std::ceil(1.0F / facing - 0.3F)), 1, kMostTextureSamples);
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();
  if (samples == 1) {
    albedo = object_.albedo(surfel.paint, surfel.point);
  } else {
    const Eigen::Vector3f along = (to_camera - facing * surfel.normal).normalized();
    const float strip_mm = surfel.depth_mm / static_cast<float>(rig_.focal_px) / facing;
    for (int i = 0; i < samples; ++i) {
      const float offset = (static_cast<float>(i) + 0.5F) / static_cast<float>(samples) - 0.5F;
      albedo += object_.albedo(surfel.paint, surfel.point + offset * strip_mm * along);
    }
    albedo /= static_cast<float>(samples);
  }
  return albedo;
}

Eigen::Vector3f Renderer::lightFrom(const Surfel& surfel, const Eigen::Vector3f& albedo,
                                    const View& view) const {
  const float lit = std::max(0.0F, surfel.normal.dot(view.light_in_table));
  Eigen::Vector3f light =
      (static_cast<float>(rig_.ambient_light) + static_cast<float>(rig_.key_light) * lit) * albedo;
  if (rig_.material == "glossy" && lit > 0.0F && surfel.paper == RayHit::kNone) {
    const Eigen::Vector3f to_camera = (view.camera_in_table - surfel.point).normalized();
    const Eigen::Vector3f mirrored =
        2.0F * surfel.normal.dot(view.light_in_table) * surfel.normal - view.light_in_table;
    const float highlight = 0.3F * std::pow(std::max(0.0F, mirrored.dot(to_camera)), 30.0F);
    light += Eigen::Vector3f::Constant(highlight);
  }
  return light;
}

bool Renderer::onEdge(int x, int y, const std::vector<Surfel>& surfels) const {
  const int width = rig_.image_width_px;
  const auto at = [&](int px, int py) -> const Surfel& {
    return surfels[static_cast<std::size_t>(py) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(px)];
  };
  const Surfel& here = at(x, y);
  const auto differs = [&](int px, int py) {
    if (px < 0 || py < 0 || px >= width || py >= rig_.image_height_px) return false;
    const Surfel& there = at(px, py);
    const bool hit = here.depth_mm > 0.0F;
    if (hit != (there.depth_mm > 0.0F)) return true;
    return hit && (std::abs(here.depth_mm - there.depth_mm) > kDepthEdge_mm ||
                   here.normal.dot(there.normal) < kNormalEdge || here.paint != there.paint);
  };
  return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
}

// Rays of neighbouring pixels differ almost evenly: a part of the difference is a sub-pixel ray.
PixelRays Renderer::raysOf(std::size_t pixel, const View& view) const {
  const auto width = static_cast<std::size_t>(rig_.image_width_px);
  const bool last_column = pixel % width + 1 == width;
  const bool last_row = pixel / width + 1 == static_cast<std::size_t>(rig_.image_height_px);
  const std::size_t left = last_column ? pixel - 1 : pixel;
  const std::size_t upper = last_row ? pixel - width : pixel;
  const auto in_table = [&](const Eigen::Vector3f& in_base) -> Eigen::Vector3d {
    return (view.table_from_base * in_base).cast<double>();
  };
  return {view.camera_in_table.cast<double>(), in_table(stage_.direction(pixel)),
          in_table(stage_.direction(left + 1) - stage_.direction(left)),
          in_table(stage_.direction(upper + width) - stage_.direction(upper))};
}

void Renderer::supersample(std::size_t pixel, const View& view, float* bgr) const {
  const auto width = static_cast<std::size_t>(rig_.image_width_px);
  const std::size_t x = pixel % width;
  const std::size_t y = pixel / width;
  const Eigen::Vector3f& centre = stage_.direction(pixel);
  const Eigen::Vector3f along_x = x + 1 < width
                                      ? Eigen::Vector3f(stage_.direction(pixel + 1) - centre)
                                      : Eigen::Vector3f(centre - stage_.direction(pixel - 1));
  const Eigen::Vector3f along_y = y + 1 < static_cast<std::size_t>(rig_.image_height_px)
                                      ? Eigen::Vector3f(stage_.direction(pixel + width) - centre)
                                      : Eigen::Vector3f(centre - stage_.direction(pixel - width));
  RayPacket rays;
  rays.origin = view.camera_in_table;
  std::array<Eigen::Vector3f, RayPacket::kSize> direction;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    const float dx = (static_cast<float>(i) + 0.5F) / 8.0F - 0.5F;
    const float dy = (static_cast<float>(kRooks[i]) + 0.5F) / 8.0F - 0.5F;
    direction[i] = centre + dx * along_x + dy * along_y;
    rays.direction[i] = view.table_from_base * direction[i];
    rays.valid[i] = true;
  }
  const Hits hits = shoot(rays, view);
  const Eigen::Vector3f behind(bgr[2], bgr[1], bgr[0]);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    if (hits.nearest[i].triangle == RayHit::kNone) {
      sum += behind;
      continue;
    }
    const Surfel surfel = hits.on_paper[i] ? paperSurfelOf(hits.nearest[i], direction[i], view)
                                           : surfelOf(hits.nearest[i], direction[i], view);
    sum += lightFrom(surfel, albedoOf(surfel, view), view).cwiseMin(1.0F);
  }
  sum /= static_cast<float>(RayPacket::kSize);
  bgr[0] = sum.z();
  bgr[1] = sum.y();
  bgr[2] = sum.x();
}

void Renderer::paintObjectRow(int y, const View& view, const std::vector<Surfel>& surfels,
                              LightImage& light) const {
  const int width = rig_.image_width_px;
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  float* row = light.row(y);
  for (int x = 0; x < width; ++x) {
    const std::size_t pixel = first + static_cast<std::size_t>(x);
    if (may_see_object_[pixel] == 0) continue;
    float* bgr = row + 3 * x;
    if (onEdge(x, y, surfels)) {
      supersample(pixel, view, bgr);
    } else if (surfels[pixel].depth_mm > 0.0F) {
      const Surfel& surfel = surfels[pixel];
      const Eigen::Vector3f albedo = surfel.paper == RayHit::kNone
                                         ? albedoOf(surfel, view)
                                         : Eigen::Vector3f::Constant(target_->reflectanceOver(
                                               surfel.paper, raysOf(pixel, view)));
      const Eigen::Vector3f rgb = lightFrom(surfel, albedo, view);
      bgr[0] = rgb.z();
      bgr[1] = rgb.y();
      bgr[2] = rgb.x();
    }
  }
}

Frame Renderer::render(std::int64_t steps, TableLoad load) const {
  if (bumped_ && isBumped(rig_, steps)) return bumped_->render(steps, load);
  const auto seed = static_cast<std::uint64_t>(rig_.seed);
  const auto step_word = static_cast<std::uint64_t>(steps);
  Random flicker(hashWords({seed, kFlickerUse, step_word, word(load)}));
  const auto brightness = static_cast<float>(1.0 + rig_.background_flicker * flicker.gaussian());
  const View view = viewAt(steps, load);
  const auto rows = static_cast<std::size_t>(rig_.image_height_px);
  const auto width = static_cast<std::size_t>(rig_.image_width_px);
  const bool with_object = view.shows_object || view.shows_target;

  LightImage light(rig_.image_width_px, rig_.image_height_px);
  std::vector<Surfel> surfels(with_object ? rows * width : 0);
  parallelFor(rows, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      stage_.paintRow(static_cast<int>(y), view.table_angle_rad, brightness, light);
      if (with_object) traceRow(static_cast<int>(y), view, surfels.data() + y * width);
    }
  });
  if (with_object) {
    parallelFor(rows, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        paintObjectRow(static_cast<int>(y), view, surfels, light);
      }
    });
  }
  return sensor_.expose(light, hashWords({seed, kNoiseUse, step_word, word(load)}));
}

std::vector<TruePixel> Renderer::truePixels(std::int64_t steps, TableLoad load) const {
  if (bumped_ && isBumped(rig_, steps)) return bumped_->truePixels(steps, load);
  const View view = viewAt(steps, load);
  const auto width = static_cast<std::size_t>(rig_.image_width_px);
  const auto rows = static_cast<std::size_t>(rig_.image_height_px);
  std::vector<TruePixel> pixels(rows * width);
  std::vector<Surfel> row(width);
  for (std::size_t y = 0; y < rows; ++y) {
    std::fill(row.begin(), row.end(), Surfel{});
    if (view.shows_object || view.shows_target) traceRow(static_cast<int>(y), view, row.data());
    for (std::size_t x = 0; x < width; ++x) {
      TruePixel& pixel = pixels[y * width + x];
      if (row[x].depth_mm > 0.0F) {
        pixel = {TruePixel::Surface::kObject, row[x].depth_mm, row[x].point, row[x].normal};
      } else if (stage_.platterCoverage(y * width + x) > 0.5F) {
        pixel.surface = TruePixel::Surface::kPlatter;
      }
    }
  }
  return pixels;
}

}  // namespace gyre
