// How long a whole reconstruction takes by the number of its views, at 1280 x 960.
//
// A turn of the default simulated duck, from pictures in memory to the final points. The last rows
// tell how well the times lie on a straight line through the origin: BigO in ns a view.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/pipeline/live_reconstruction.h"
#include "tests/bench/rendered_turn.h"

namespace gyre {
namespace {

constexpr int kMostViews = 400;

struct World {
  Renderer renderer{RigSettings{}};
  FramePtr empty_table = bench::renderEmptyTable(renderer);
  std::vector<FramePtr> frames = bench::renderViews(renderer, kMostViews, kMostViews);
};

const World& world() {
  static const World kWorld;
  return kWorld;
}

// Argument: views of the turn.
void reconstruct(benchmark::State& state) {
  const auto frames =
      bench::everyNth(world().frames, static_cast<std::size_t>(kMostViews / state.range(0)));
  Reconstruction result;
  for (auto _ : state) {
    LiveReconstruction live =
        LiveReconstruction::create(trueCalibration(world().renderer.rig()), world().empty_table)
            .value();
    for (const FramePtr& frame : frames) benchmark::DoNotOptimize(live.addFrame(frame).value());
    result = live.finish({}).value();
  }
  state.SetComplexityN(state.range(0));
  state.counters["s_per_view"] = benchmark::Counter(
      static_cast<double>(state.range(0)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  for (const auto& [stage, seconds] : result.seconds) state.counters[stage + "_s"] = seconds;
  state.counters["points"] = static_cast<double>(result.cloud.points.size());
}
BENCHMARK(reconstruct)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Iterations(1)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kSecond)
    ->Complexity(benchmark::oN);

}  // namespace
}  // namespace gyre

BENCHMARK_MAIN();
