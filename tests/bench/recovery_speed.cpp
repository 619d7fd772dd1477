// How long finding a point takes, a sighting: by the paper's closed forms and robustly.
//
// Points of the paper's synthetic experiment at 0.3 px, by one thread. Read the column
// s_per_sighting: 8n are 8 ns.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/geometry/ray.h"
#include "core/recover/point_estimator.h"
#include "core/recover/ray_intersection.h"
#include "core/sim/synthetic_turn.h"

namespace gyre {
namespace {

// So many that no branch is learnt by heart, so few that they stay in the processor's cache.
constexpr int kTracks = 64;
constexpr double kFurthestOff_px = 40.0;

struct Scene {
  std::vector<Rigid3> cam_from_table;
  std::vector<std::vector<Sighting>> tracks;
};

// Moves so many of the pixels, drawn from all, to somewhere within 40 px.
void spoil(std::size_t wrong, Random& random, std::vector<Eigen::Vector2d>& pixels) {
  for (std::size_t i = 0; i < pixels.size() && wrong > 0; ++i) {
    if (random.below(pixels.size() - i) >= wrong) continue;
    --wrong;
    for (double& coordinate : pixels[i]) {
      coordinate += random.uniform(-kFurthestOff_px, kFurthestOff_px);
    }
  }
}

// wrong_share: of the sightings of every track, each somewhere within 40 px.
Scene sceneOf(int views, double wrong_share) {
  SyntheticTurnOptions options;
  options.views = views;
  options.points = kTracks;
  options.noise_px = 0.3;
  options.whole_pixels = false;
  const SyntheticTurn turn = syntheticTurn(options, 1);
  Random random(1);
  Scene scene{turn.cam_from_table, {}};
  for (const Track& track : turn.tracks) {
    std::vector<Eigen::Vector2d> pixels;
    for (const Observation& each : track.observations) pixels.push_back(each.pixel);
    spoil(static_cast<std::size_t>(std::lround(wrong_share * views)), random, pixels);
    std::vector<Sighting> sightings;
    for (int view = 0; view < views; ++view) {
      sightings.push_back({view,
                           turn.camera.normalizedFromPixel(pixels[static_cast<std::size_t>(view)]),
                           turn.sigma_px / turn.camera.fx});
    }
    scene.tracks.push_back(std::move(sightings));
  }
  return scene;
}

std::vector<Ray> raysOf(const Scene& scene, const std::vector<Sighting>& sightings) {
  std::vector<Ray> rays;
  rays.reserve(sightings.size());
  for (const Sighting& each : sightings) {
    rays.push_back(
        rayThrough(scene.cam_from_table[static_cast<std::size_t>(each.view)], each.normalized));
  }
  return rays;
}

// Every iteration went through all tracks.
void countSightings(benchmark::State& state) {
  state.counters["s_per_sighting"] = benchmark::Counter(
      static_cast<double>(kTracks * state.range(0)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

using Intersect = std::optional<Eigen::Vector3d> (*)(std::span<const Ray>);

// Argument: sightings a track. The rays are ready.
void intersect(benchmark::State& state, Intersect intersection) {
  const Scene scene = sceneOf(static_cast<int>(state.range(0)), 0.0);
  std::vector<std::vector<Ray>> tracks;
  for (const auto& sightings : scene.tracks) tracks.push_back(raysOf(scene, sightings));
  for (auto _ : state) {
    for (const auto& rays : tracks) benchmark::DoNotOptimize(intersection(rays));
  }
  countSightings(state);
}
BENCHMARK_CAPTURE(intersect, Squared, intersectRays)->Arg(10)->Arg(30)->Arg(100);
BENCHMARK_CAPTURE(intersect, Absolute, intersectRaysAbsolute)->Arg(10)->Arg(30)->Arg(100);

// Argument: sightings a track. From sightings and poses, as a track comes.
void castAndIntersect(benchmark::State& state) {
  const Scene scene = sceneOf(static_cast<int>(state.range(0)), 0.0);
  for (auto _ : state) {
    for (const auto& track : scene.tracks) {
      benchmark::DoNotOptimize(intersectRays(raysOf(scene, track)));
    }
  }
  countSightings(state);
}
BENCHMARK(castAndIntersect)->Arg(10)->Arg(30)->Arg(100);

// Arguments: sightings a track, percent of them that are wrong. With covariance, and the verdict on
// every sighting.
void estimate(benchmark::State& state, const std::string& solver) {
  const Scene scene =
      sceneOf(static_cast<int>(state.range(0)), 0.01 * static_cast<double>(state.range(1)));
  RecoverOptions options;
  options.solver = solver;
  options.min_agreeing = 0.5;  // a track given up early would look fast
  PointEstimator estimator = PointEstimator::create(options).value();
  for (const Rigid3& pose : scene.cam_from_table) estimator.addPose(pose);
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
      found += estimator.estimate(scene.tracks[i], i) ? 1 : 0;
    }
  }
  GYRE_CHECK(found == scene.tracks.size());
  countSightings(state);
}
BENCHMARK_CAPTURE(estimate, Squared, "squared")->ArgsProduct({{10, 30, 100}, {0}});
BENCHMARK_CAPTURE(estimate, Robust, "robust")->ArgsProduct({{10, 30, 100}, {0, 20}});

}  // namespace
}  // namespace gyre

BENCHMARK_MAIN();
