// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/poisson.h"

#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_complex_2_in_triangulation_3.h>
#include <CGAL/Surface_mesh_default_criteria_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>
#include <CGAL/property_map.h>

#include "core/base/median.h"
#include "core/mesh/clean/orient.h"
#include "core/mesh/clean/surface_mesh.h"
#include "core/mesh/kd_tree.h"
#include "core/mesh/surface_points.h"

namespace gyre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point3 = Kernel::Point_3;
using Sphere3 = Kernel::Sphere_3;
using Oriented = std::pair<Point3, Kernel::Vector_3>;
using Field = CGAL::Poisson_reconstruction_function<Kernel>;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using SurfaceMesh = CGAL::Surface_mesh<Point3>;

constexpr double kLeastAngle_deg = 20.0;
constexpr double kLargestBall = 1.0;       // around a facet, in spacings
constexpr double kFarthestMiddle = 0.375;  // of a facet from the surface, in spacings
constexpr double kRootShare = 1e-3;        // of that: how exactly the surface is hit
constexpr double kSearchRadii = 5.0;       // of the points' own ball
constexpr double kSeenWithin = 2.0;        // spacings from a point

struct Stopped : std::exception {};

// Leaves the meshing by an exception as soon as the task is stopped.
struct ListeningField {
  using Point = Point3;
  using FT = Kernel::FT;

  const Field* field;
  const Task* task;

  FT operator()(const Point& place) const {
    if (task->stopRequested()) throw Stopped();
    return (*field)(place);
  }
};

std::vector<Oriented> orientedPoints(const PointCloud& cloud) {
  std::vector<Oriented> points;
  points.reserve(cloud.points.size());
  for (const Point& point : cloud.points) {
    if (point.normal.isZero()) continue;
    points.emplace_back(Point3(point.position.x(), point.position.y(), point.position.z()),
                        Kernel::Vector_3(point.normal.x(), point.normal.y(), point.normal.z()));
  }
  return points;
}

Error noSurface() {
  return {Error::Code::kTooFew, "No smooth surface follows the points' normals.",
          "Use another method: closed, where the lines of sight are known, or alpha."};
}

Result<Mesh> levelSet(const std::vector<Oriented>& points, double spacing_mm, const Task& task) {
  Field field(points.begin(), points.end(), CGAL::First_of_pair_property_map<Oriented>(),
              CGAL::Second_of_pair_property_map<Oriented>());
  if (!field.compute_implicit_function()) return noSurface();
  if (task.stopRequested()) return cancelled();
  task.report(0.5, "Meshing the smooth surface");
  const Sphere3 ball = field.bounding_sphere();
  const double radius_mm = kSearchRadii * std::sqrt(ball.squared_radius());
  const CGAL::Implicit_surface_3<Kernel, ListeningField> surface(
      ListeningField{&field, &task}, Sphere3(field.get_inner_point(), radius_mm * radius_mm),
      kRootShare * kFarthestMiddle * spacing_mm / radius_mm);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(
      kLeastAngle_deg, kLargestBall * spacing_mm, kFarthestMiddle * spacing_mm);
  Triangulation triangulation;
  CGAL::Surface_mesh_complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag());
  SurfaceMesh skin;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, skin);
  if (skin.number_of_faces() == 0) return noSurface();
  return meshOf(skin);
}

void takeAttributes(Mesh& mesh, const SurfacePoints& points) {
  const KdTree tree(positionsOf(points.cloud));
  for (MeshVertex& vertex : mesh.vertices) {
    const auto nearest = tree.nearest(vertex.position, 1).front();
    const Eigen::Vector3d position = vertex.position;
    vertex = vertexOf(points.cloud.points[nearest.index]);
    vertex.position = position;
    const double reach_mm = kSeenWithin * points.spacing_mm[nearest.index];
    if (nearest.squared_mm2 <= reach_mm * reach_mm) continue;
    vertex.seen = 0;
    vertex.views = 0;
    vertex.sigma_mm = 0.0F;
  }
}

}  // namespace

Result<Mesh> poissonMesh(const PointCloud& cloud, const PoissonOptions& options, const Task& task) {
  if (const auto valid = options.validate(); !valid) return valid.error();
  const auto points = surfacePoints(cloud, options.spacing_mm, task.part(0.0, 0.2));
  if (!points) return points.error();
  const double spacing_mm =
      options.spacing_mm > 0.0 ? options.spacing_mm : median(points->spacing_mm);
  task.report(0.2, "Fitting a smooth surface to the normals");
  auto made = guarded("The Poisson reconstruction", [&]() -> Result<Mesh> {
    try {
      return levelSet(orientedPoints(points->cloud), spacing_mm, task.part(0.2, 0.9));
    } catch (const Stopped&) {
      return cancelled();
    }
  });
  if (!made) return made;
  auto oriented = orientOutwards(*made, task.part(0.9, 1.0));
  if (!oriented) return oriented.error();
  takeAttributes(oriented->mesh, *points);
  computeNormals(oriented->mesh);
  return std::move(oriented->mesh);
}

}  // namespace gyre
