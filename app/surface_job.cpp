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

Result<Mesh> meshOfSights(const PointCloud& cloud, const std::filesystem::path& folder,
                          MeshMethod method, const Task& task) {
  const auto sights = readSights(folder, cloud);
  if (!sights) return sights.error();
  MeshRequest request;
  request.method = method;
  auto made = makeMesh(cloud, *sights, request, task);
  if (!made) return made.error();
  return std::move(made->mesh);
}

}  // namespace

Result<MadeSurface> makeSurface(const PointCloud& cloud, const std::filesystem::path& folder,
                                const SurfaceWish& wish,
                                std::shared_ptr<const AlphaShape> alpha_shape, const Task& task) {
  auto mesh = wish.method == MeshMethod::kAlpha
                  ? meshOfAlphaShape(cloud, wish.gap_size_mm, alpha_shape, task)
                  : meshOfSights(cloud, folder, wish.method, task);
  if (!mesh) return mesh.error();
  MadeSurface made;
  made.health = meshHealth(*mesh);
  made.mesh = std::make_shared<const Mesh>(std::move(*mesh));
  made.alpha_shape = std::move(alpha_shape);
  return made;
}

}  // namespace gyre
