// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/make_mesh.h"

#include <utility>

#include "core/mesh/adaptive_alpha.h"
#include "core/mesh/alpha_shape.h"
#include "core/mesh/clean/curve_underside.h"
#include "core/mesh/clean/mend_self_intersections.h"
#include "core/mesh/clean/poisson.h"
#include "core/mesh/clean/wrap.h"
#include "core/mesh/vertex_colours.h"
#include "core/mesh/visibility_cut.h"
#include "core/mesh/visual_hull.h"

namespace gyre {
namespace {

Error needsSights(MeshMethod method) {
  return {Error::Code::kInvalidInput,
          "The method \"" + std::string(wordOf(method)) +
              "\" follows the lines of sight of the points, and these are not known.",
          "Give the folder of a reconstruction, with visibility.bin, calibration.json and "
          "angles_solved.csv beside the points; or use --method alpha."};
}

Result<MadeMesh> byAlphaShape(const PointCloud& cloud, const AlphaShapeOptions& options,
                              const Task& task) {
  auto shape = alphaShapeMesh(cloud, options, task);
  if (!shape) return shape.error();
  return MadeMesh{std::move(shape->mesh), MeshMethod::kAlpha, shape->alpha_mm};
}

// The cut; a part of the underside that it could only guess is bent as the surface around it, and
// where guessed parts pass through others these are mended. What neither can do stays as it was.
Result<MadeMesh> byCut(const PointCloud& cloud, const SightEvidence& sights,
                       const VisibilityCutOptions& options, const Task& task) {
  auto cut = visibilityCut(cloud, sights, options, task.part(0.0, 0.9));
  if (!cut) return cut.error();
  auto shaped = curveUnderside(cut->mesh, task.part(0.9, 0.95));
  if (!shaped && shaped.error().code == Error::Code::kCancelled) return shaped.error();
  Mesh& mesh = shaped ? shaped->mesh : cut->mesh;
  auto mended = mendSelfIntersections(mesh, task.part(0.95, 1.0));
  if (!mended && mended.error().code == Error::Code::kCancelled) return mended.error();
  return MadeMesh{std::move(mended ? mended->mesh : mesh), MeshMethod::kClosed, 0.0};
}

Result<MadeMesh> byOutlines(const PointCloud& cloud, const SightEvidence& sights,
                            const VisualHullOptions& options, const Task& task) {
  auto hull = visualHull(sights, options, task);
  if (!hull) return hull.error();
  if (!cloud.points.empty()) colourFromPoints(hull->mesh, cloud);
  return MadeMesh{std::move(hull->mesh), MeshMethod::kSilhouette, 0.0};
}

Result<MadeMesh> byWrap(const PointCloud& cloud, const std::optional<SightEvidence>& sights,
                        const MeshRequest& request, const Task& task) {
  MeshRequest first = request;
  first.method = MeshMethod::kAuto;
  const auto made = makeMesh(cloud, sights, first, task.part(0.0, 0.5));
  if (!made) return made.error();
  auto wrapped = wrapMesh(made->mesh, request.wrap, task.part(0.5, 1.0));
  if (!wrapped) return wrapped.error();
  return MadeMesh{std::move(wrapped->mesh), MeshMethod::kWatertight, wrapped->alpha_mm};
}

}  // namespace

Result<MadeMesh> makeMesh(const PointCloud& cloud, const std::optional<SightEvidence>& sights,
                          const MeshRequest& request, const Task& task) {
  switch (request.method) {
    case MeshMethod::kAlpha:
      return byAlphaShape(cloud, request.alpha, task);
    case MeshMethod::kClosed: {
      if (!sights) return needsSights(request.method);
      return byCut(cloud, *sights, request.cut, task);
    }
    case MeshMethod::kAdaptive: {
      auto shape = adaptiveAlphaMesh(cloud, sights.value_or(SightEvidence()), request.alpha, task);
      if (!shape) return shape.error();
      return MadeMesh{std::move(shape->mesh), MeshMethod::kAdaptive, 0.0};
    }
    case MeshMethod::kPoisson: {
      auto surface = poissonMesh(cloud, request.poisson, task);
      if (!surface) return surface.error();
      return MadeMesh{std::move(*surface), MeshMethod::kPoisson, 0.0};
    }
    case MeshMethod::kSilhouette:
      if (!sights) return needsSights(request.method);
      return byOutlines(cloud, *sights, request.hull, task);
    case MeshMethod::kWatertight:
      return byWrap(cloud, sights, request, task);
    case MeshMethod::kAuto: {
      MeshRequest chosen = request;
      chosen.method = sights ? MeshMethod::kClosed : MeshMethod::kAlpha;
      return makeMesh(cloud, sights, chosen, task);
    }
  }
  return needsSights(request.method);
}

}  // namespace gyre
