// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/solver.h"

#include <cmath>

#include "core/base/check.h"
#include "core/recover/ray_intersection.h"

namespace gyre {
namespace {

// The first ray and the one that crosses it most squarely.
std::optional<Eigen::Vector3d> bestTwoRays(std::span<const Ray> rays) {
  if (rays.size() < 2) return std::nullopt;
  const Ray* partner = &rays.back();
  double least_cosine = 1.0;
  for (const Ray& ray : rays.subspan(1)) {
    const double cosine = std::abs(ray.direction.dot(rays.front().direction));
    if (cosine < least_cosine) {
      least_cosine = cosine;
      partner = &ray;
    }
  }
  return intersectTwoRays(rays.front(), *partner);
}

}  // namespace

std::optional<Solver> solverFromName(std::string_view name) {
  if (name == "two-view") return Solver::kTwoView;
  if (name == "squared") return Solver::kSquared;
  if (name == "absolute") return Solver::kAbsolute;
  if (name == "robust") return Solver::kRobust;
  return std::nullopt;
}

std::optional<Eigen::Vector3d> intersectByPaper(Solver solver, std::span<const Ray> rays) {
  GYRE_CHECK(solver != Solver::kRobust);
  if (solver == Solver::kTwoView) return bestTwoRays(rays);
  if (solver == Solver::kSquared) return intersectRays(rays);
  return intersectRaysAbsolute(rays);
}

}  // namespace gyre
