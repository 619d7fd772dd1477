// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/alpha_wrap.h"

#include <array>
#include <cstddef>
#include <exception>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "core/mesh/clean/surface_mesh.h"

namespace gyre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point3 = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point3>;

struct Stopped : std::exception {};

// Leaves the wrapping by an exception as soon as the task is stopped.
struct StopVisitor : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
  explicit StopVisitor(const Task& for_task) : task(&for_task) {}

  template <class Wrapper, class Gate>
  void before_facet_treatment(const Wrapper& /*wrapper*/,
                              const Gate& /*gate*/) {  // NOLINT(*-naming)
    if (task->stopRequested()) throw Stopped();
  }

  const Task* task;
};

std::vector<Point3> pointsOf(const Mesh& mesh) {
  std::vector<Point3> points;
  points.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    points.emplace_back(vertex.position.x(), vertex.position.y(), vertex.position.z());
  }
  return points;
}

}  // namespace

Result<Mesh> alphaWrap(const Mesh& input, const WrapSize& size, const Task& task) {
  return guarded("The wrapping", [&]() -> Result<Mesh> {
    try {
      const std::vector<Point3> points = pointsOf(input);
      StopVisitor visitor(task);
      const auto listening = CGAL::parameters::visitor(visitor);
      SurfaceMesh skin;
      if (input.triangles.empty()) {
        CGAL::alpha_wrap_3(points, size.alpha_mm, size.offset_mm, skin,
                           CGAL::parameters::default_values(), listening);
        return meshOf(skin);
      }
      std::vector<std::array<std::size_t, 3>> faces;
      faces.reserve(input.triangles.size());
      for (const auto& [a, b, c] : input.triangles) faces.push_back({a, b, c});
      CGAL::alpha_wrap_3(points, faces, size.alpha_mm, size.offset_mm, skin,
                         CGAL::parameters::default_values(), listening);
      return meshOf(skin);
    } catch (const Stopped&) {
      return cancelled();
    }
  });
}

}  // namespace gyre
