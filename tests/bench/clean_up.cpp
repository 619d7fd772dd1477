// How long each step of cleaning up takes, and how near it stays to a simulated object.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/base/median.h"
#include "core/base/random.h"
#include "core/mesh/clean/base_cap.h"
#include "core/mesh/clean/clean_mesh.h"
#include "core/mesh/clean/crop.h"
#include "core/mesh/clean/decimate.h"
#include "core/mesh/clean/fill_holes.h"
#include "core/mesh/clean/remesh.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/clean/smooth.h"
#include "core/mesh/clean/split_non_manifold.h"
#include "core/mesh/clean/wrap.h"
#include "core/mesh/components.h"
#include "core/mesh/mesh_health.h"
#include "core/mesh/surface_index.h"
#include "core/sim/objects.h"

namespace gyre {
namespace {

constexpr double kSigma_mm = 0.03;

// The true object, and a scan of it: noisy along the normals, with three holes, the lowest
// millimetre missing.
struct Case {
  Mesh truth;
  Mesh scan;
};

Case makeCase(const std::string& object) {
  RigSettings rig;
  rig.object = object;
  Case made;
  made.truth = SimObject(rig).mesh();
  Mesh mesh = made.truth;
  Random random(1);
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.position += kSigma_mm * random.gaussian() * vertex.normal;
    vertex.sigma_mm = static_cast<float>(kSigma_mm);
  }
  for (int hole = 0; hole < 3; ++hole) {
    const Eigen::Vector3d at = mesh.vertices[random.below(mesh.vertices.size())].position;
    std::erase_if(mesh.triangles, [&](const Triangle& corners) {
      return (mesh.vertices[corners[0]].position - at).norm() < 3.0;
    });
  }
  removeUnusedVertices(mesh);
  made.scan = splitNonManifold(cropMesh(mesh, {.z_min_mm = 1.0}, {})->mesh, {})->mesh;
  removeSmallComponents(made.scan, 0.01);
  return made;
}

const Case& caseOf(const std::string& object) {
  static std::map<std::string, Case> cases;
  const auto known = cases.find(object);
  return known != cases.end() ? known->second
                              : cases.emplace(object, makeCase(object)).first->second;
}

// Distances of the vertices from the truth, and what the health says.
void tell(benchmark::State& state, const Mesh& mesh, const Mesh& truth) {
  const SurfaceIndex index(truth);
  std::vector<double> distances_mm;
  for (const MeshVertex& vertex : mesh.vertices) {
    if (vertex.seen != 0) distances_mm.push_back(index.nearest(vertex.position).distance_mm);
  }
  const MeshHealth health = meshHealth(mesh);
  state.counters["triangles"] = static_cast<double>(health.triangles);
  state.counters["median_um"] = 1000.0 * median(distances_mm);
  state.counters["p95_um"] = 1000.0 * quantile(distances_mm, 0.95);
  state.counters["holes"] = static_cast<double>(health.holes);
  state.counters["euler"] = static_cast<double>(health.euler_number);
  state.counters["unseen_pct"] = 100.0 * health.unseen_area_mm2 / health.area_mm2;
  state.counters["volume_pct"] = 100.0 * (health.volume_mm3 / meshHealth(truth).volume_mm3 - 1.0);
  const auto crossings = countSelfIntersections(mesh, {});
  state.counters["crossings"] = crossings ? static_cast<double>(*crossings) : -1.0;
}

using Step = std::function<Result<Mesh>(const Case&)>;

template <class Made>
Result<Mesh> meshIn(Result<Made> made) {
  if (!made) return made.error();
  return std::move(made->mesh);
}

void run(benchmark::State& state, const std::string& object, const Step& step) {
  const Case& scan = caseOf(object);
  Mesh mesh;
  for (auto _ : state) {
    auto made = step(scan);
    if (!made) {
      state.SkipWithError(made.error().sentence().c_str());
      return;
    }
    mesh = std::move(*made);
  }
  tell(state, mesh, scan.truth);
}

Mesh closed(const Case& scan) {
  auto filled = fillHoles(scan.scan, {.max_width_mm = 12.0, .spare_below_mm = 5.0}, {});
  return capBase(filled->mesh, {}, {})->mesh;
}

CleanOptions smoothed(int iterations) {
  CleanOptions options;
  options.smooth.iterations = iterations;
  return options;
}

CleanOptions cropped(double radius_mm) {
  CleanOptions options;
  options.crop.radius_mm = radius_mm;
  return options;
}

// What the window does for every change of a number: here it goes to and fro.
Result<Mesh> preview(const Case& scan, const CleanOptions& here, const CleanOptions& there) {
  static RepeatedCleanUp clean_up;
  static MeshPtr mesh;
  static const Case* mesh_of = nullptr;
  static bool to = false;
  if (mesh_of != &scan) mesh = std::make_shared<const Mesh>(scan.scan);
  mesh_of = &scan;
  to = !to;
  return meshIn(clean_up.run(mesh, to ? there : here, {}));
}

const std::vector<std::pair<std::string, Step>> kSteps = {
    {"scan", [](const Case& scan) -> Result<Mesh> { return scan.scan; }},
    {"fill",
     [](const Case& scan) {
       return meshIn(fillHoles(scan.scan, {.max_width_mm = 12.0, .spare_below_mm = 5.0}, {}));
     }},
    {"fill_cap", [](const Case& scan) -> Result<Mesh> { return closed(scan); }},
    {"smooth",
     [](const Case& scan) {
       return meshIn(smoothMesh(scan.scan, {.iterations = 10, .max_sigmas = 2.0}, {}));
     }},
    {"decimate",
     [](const Case& scan) {
       return meshIn(decimateMesh(closed(scan), {.triangles = 50000, .hold_z_mm = 0.0}, {}));
     }},
    {"remesh",
     [](const Case& scan) { return meshIn(remeshEvenly(closed(scan), {.edge_mm = 0.8}, {})); }},
    {"wrap_capped",
     [](const Case& scan) {
       return meshIn(wrapMesh(closed(scan), {.alpha_mm = 1.5, .offset_mm = 0.2}, {}));
     }},
    {"wrap_points",
     [](const Case& scan) {
       Mesh points = scan.scan;
       points.triangles.clear();
       return meshIn(wrapMesh(points, {}, {}));
     }},
    {"clean_smooth",
     [](const Case& scan) { return meshIn(cleanMesh(scan.scan, smoothed(5), {})); }},
    {"preview_smooth", [](const Case& scan) { return preview(scan, smoothed(5), smoothed(6)); }},
    {"clean_crop",
     [](const Case& scan) { return meshIn(cleanMesh(scan.scan, cropped(25.0), {})); }},
    {"preview_crop", [](const Case& scan) { return preview(scan, cropped(25.0), cropped(24.5)); }},
    {"crossings",
     [](const Case& scan) -> Result<Mesh> {
       const auto count = countSelfIntersections(scan.scan, {});
       if (!count) return count.error();
       return scan.scan;
     }},
};

}  // namespace
}  // namespace gyre

int main(int argc, char** argv) {
  for (const std::string object : {"duck", "vase", "bowl"}) {
    for (const auto& step : gyre::kSteps) {
      const std::string name = object + "/" + step.first;
      benchmark::RegisterBenchmark(
          name.c_str(),
          [object, &step](benchmark::State& state) { gyre::run(state, object, step.second); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(step.first.starts_with("preview") ? 20 : 1);  // the first is as long as all
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
