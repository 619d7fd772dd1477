// How long the live overlay takes at 1280 x 960, for a picture with the target and one without.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <benchmark/benchmark.h>

#include <string>

#include "core/calib/match/target_preview.h"
#include "core/calib/targets/standard_targets.h"
#include "core/sim/renderer.h"

namespace gyre {
namespace {

void previewOf(benchmark::State& state, const std::string& name, TableLoad load) {
  RigSettings rig;
  rig.object = "target";
  const Target target = standardTarget(name)->target;
  const Renderer renderer(rig, PrintedTarget::make(target, rig).value());
  const cv::Mat image = renderer.render(rig.steps_per_turn / 9, load).image_bgr;
  for (auto step : state) benchmark::DoNotOptimize(previewTarget(image, target));
}

BENCHMARK_CAPTURE(previewOf, Wedge, "wedge", TableLoad::kObject)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(previewOf, CodedCube, "coded-cube", TableLoad::kObject)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(previewOf, Cube, "cube", TableLoad::kObject)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(previewOf, NoWedge, "wedge", TableLoad::kEmpty)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(previewOf, NoCube, "cube", TableLoad::kEmpty)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyre

BENCHMARK_MAIN();
