// How long surfaces take, and how that grows with the number of points: docs/performance.md.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include "core/base/random.h"
#include "core/mesh/alpha_filtration.h"
#include "core/mesh/alpha_shape.h"
#include "core/mesh/surface_points.h"
#include "core/mesh/visibility_cut.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

constexpr std::uint32_t kCameras = 24;

// Random points on a wavy sphere of 40 mm, a twentieth of the spacing off it, seen by 24 cameras.
PointCloud wavySphere(std::size_t count) {
  Random random(5);
  PointCloud cloud;
  const double noise_mm = 0.05 * std::sqrt(4.0 * kPi * 1600.0 / static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d out =
        Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
    const double radius_mm = 40.0 + 2.0 * std::sin(8.0 * out.x()) * std::sin(8.0 * out.z());
    Point point = test::surfacePoint((radius_mm + noise_mm * random.gaussian()) * out, out);
    point.covariance = noise_mm * noise_mm * Eigen::Matrix3d::Identity();
    for (std::uint32_t camera = 0; camera < kCameras; ++camera) {
      if (test::spiralDirection(camera, kCameras).dot(out) > 0.4) point.views.push_back(camera);
    }
    cloud.points.push_back(std::move(point));
  }
  return cloud;
}

void BareDelaunay(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  for (const Point& point : wavySphere(static_cast<std::size_t>(state.range(0))).points) {
    points.emplace_back(point.position.x(), point.position.y(), point.position.z());
  }
  for (auto _ : state) {
    const CGAL::Delaunay_triangulation_3<Kernel> triangulation(points.begin(), points.end());
    benchmark::DoNotOptimize(triangulation.number_of_cells());
  }
}

void AlphaComplex(benchmark::State& state) {
  const auto points = positionsOf(wavySphere(static_cast<std::size_t>(state.range(0))));
  for (auto _ : state) {
    const AlphaFiltration filtration(*delaunay(points, {}));
    benchmark::DoNotOptimize(filtration.tetrahedra().cells());
  }
}

void AnotherAlpha(benchmark::State& state) {
  AlphaShapeOptions options;
  options.spacing_mm = 1e-6;  // keep every point
  const auto shape =
      AlphaShape::prepare(wavySphere(static_cast<std::size_t>(state.range(0))), options, {});
  const double spacing_mm = std::sqrt(4.0 * kPi * 1600.0 / static_cast<double>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(shape->at(4.0 * spacing_mm)->mesh.triangles.size());
  }
}

void VisibilityCut(benchmark::State& state) {
  const PointCloud cloud = wavySphere(static_cast<std::size_t>(state.range(0)));
  SightEvidence sights;
  for (std::uint32_t i = 0; i < kCameras; ++i) {
    sights.camera_centres.push_back(350.0 * test::spiralDirection(i, kCameras));
  }
  for (auto _ : state) {
    const auto cut = visibilityCut(cloud, sights, {}, {});
    state.counters["vertices"] = static_cast<double>(cut->mesh.vertices.size());
  }
}

BENCHMARK(BareDelaunay)->Unit(benchmark::kMillisecond)->Arg(10000)->Arg(100000)->Arg(1000000);
BENCHMARK(AlphaComplex)->Unit(benchmark::kMillisecond)->Arg(10000)->Arg(100000)->Arg(1000000);
BENCHMARK(AnotherAlpha)->Unit(benchmark::kMillisecond)->Arg(10000)->Arg(50000);
BENCHMARK(VisibilityCut)->Unit(benchmark::kMillisecond)->Arg(10000)->Arg(100000)->Arg(1000000);

}  // namespace
}  // namespace gyre

BENCHMARK_MAIN();
