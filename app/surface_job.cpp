// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/surface_job.h"

#include <utility>

#include "core/mesh/mesh_health.h"
#include "core/pipeline/make_mesh.h"
#include "core/pipeline/sights.h"

namespace gyre {
namespace {

Result<Mesh> meshOfAlphaShape(const PointCloud& cloud, double gap_size_mm,
                              std::shared_ptr<const AlphaShape>& shape, const Task& task) {
  if (!shape) {
    auto prepared = AlphaShape::prepare(cloud, {}, task);
    if (!prepared) return prepared.error();
    shape = std::make_shared<const AlphaShape>(std::move(*prepared));
  }
  auto made = shape->at(gap_size_mm > 0.0 ? gap_size_mm : shape->automaticAlphaMm());
  if (!made) return made.error();
  return std::move(made->mesh);
}

// Kinds that make something of points alone; all others follow lines of sight.
bool doesWithoutSights(MeshMethod method) {
  return method == MeshMethod::kAuto || method == MeshMethod::kAdaptive ||
         method == MeshMethod::kPoisson || method == MeshMethod::kWatertight;
}

std::string remarkWithoutSights(MeshMethod method) {
  return method == MeshMethod::kAdaptive
             ? "From where these points were seen is not known, so gaps may be bridged through "
               "which a camera looked."
             : "From where these points were seen is not known, so the surface is made of the "
               "points alone and may stay open.";
}

Result<MadeSurface> surfaceOfSights(const PointCloud& cloud, const std::filesystem::path& folder,
                                    MeshMethod method, const Task& task) {
  const auto sights = readSights(folder, cloud);
  if (!sights) return sights.error();
  if (!*sights && !doesWithoutSights(method)) {
    return Error{Error::Code::kInvalidInput,
                 "This kind of surface follows the lines of sight of the points, and these are not "
                 "known.",
                 "Open the scan's folder instead of a file of points, or choose a surface that "
                 "stays open."};
  }
  MeshRequest request;
  request.method = method;
  auto mesh = makeMesh(cloud, *sights, request, task);
  if (!mesh) return mesh.error();
  MadeSurface made;
  made.mesh = std::make_shared<const Mesh>(std::move(mesh->mesh));
  if (!*sights && method != MeshMethod::kPoisson) made.remark = remarkWithoutSights(method);
  return made;
}

Result<MadeSurface> surfaceOfAlphaShape(const PointCloud& cloud, double gap_size_mm,
                                        std::shared_ptr<const AlphaShape> shape, const Task& task) {
  auto mesh = meshOfAlphaShape(cloud, gap_size_mm, shape, task);
  if (!mesh) return mesh.error();
  MadeSurface made;
  made.mesh = std::make_shared<const Mesh>(std::move(*mesh));
  made.alpha_shape = std::move(shape);
  return made;
}

}  // namespace

Result<MadeSurface> makeSurface(const PointCloud& cloud, const std::filesystem::path& folder,
                                const SurfaceWish& wish,
                                std::shared_ptr<const AlphaShape> alpha_shape, const Task& task) {
  auto made = wish.method == MeshMethod::kAlpha
                  ? surfaceOfAlphaShape(cloud, wish.gap_size_mm, alpha_shape, task)
                  : surfaceOfSights(cloud, folder, wish.method, task);
  if (!made) return made;
  made->health = meshHealth(*made->mesh);
  if (!made->alpha_shape) made->alpha_shape = std::move(alpha_shape);
  return made;
}

}  // namespace gyre
