// How long the drift monitor takes for one picture of 1280 x 960, of the default simulated rig.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include <benchmark/benchmark.h>

#include "core/sim/renderer.h"
#include "core/track/drift_monitor.h"

namespace gyre {
namespace {

constexpr int kViews = 12;

std::vector<Frame> turnOf(const RigSettings& rig) {
  const Renderer renderer(rig);
  std::vector<Frame> frames;
  for (int view = 0; view < kViews; ++view) {
    const std::int64_t steps = rig.steps_per_turn * view / kViews;
    frames.push_back(renderer.render(steps, TableLoad::kObject));
    frames.back().view = view;
    frames.back().table_angle_rad = trueAngleRad(rig, steps);
  }
  return frames;
}

// Argument: by how many tenths of a pixel the camera is knocked in the middle of the turn.
void addFrame(benchmark::State& state) {
  RigSettings rig;
  rig.bump_px = 0.1 * static_cast<double>(state.range(0));
  const std::vector<Frame> frames = turnOf(rig);
  for (auto _ : state) {
    DriftMonitor monitor;
    for (const Frame& frame : frames) {
      monitor.addFrame(frame);
      benchmark::DoNotOptimize(monitor.latest());
    }
    const DriftReport report = monitor.report();
    state.counters["last_px"] = report.views.back().px;
    state.counters["sigma_px"] = report.views.back().sigma_px;
    state.SetLabel(report.sentence);
  }
  state.counters["s_per_frame"] = benchmark::Counter(
      static_cast<double>(kViews),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(addFrame)->Arg(0)->Arg(3)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyre

BENCHMARK_MAIN();
