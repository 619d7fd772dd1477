// How long following features takes, at 1280 x 960: a feature, and a picture full of them.
//
// Pictures of the default simulated duck, 200 views a turn.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include "core/base/random.h"
#include "core/geometry/turntable_pose.h"
#include "core/pipeline/live_reconstruction.h"
#include "core/track/empty_table_mask.h"
#include "core/track/feature_detector.h"
#include "core/track/feature_tracker.h"
#include "core/track/grey_pyramid.h"
#include "core/track/klt_step.h"
#include "core/track/reference_patch.h"
#include "core/track/track_gates.h"
#include "tests/bench/rendered_turn.h"

namespace gyre {
namespace {

constexpr int kViewsPerTurn = 200;
// Until then tracks grow longer from view to view, and each view costs more than the one before.
constexpr int kViewsBefore = 50;
constexpr int kViewsTimed = 50;
// Away from the true place, as predictions are: either way, in either direction.
constexpr double kPredictedWithin_px = 1.0;

struct World {
  Renderer renderer{RigSettings{}};
  Calibration calibration = trueCalibration(renderer.rig());
  FramePtr empty_table = bench::renderEmptyTable(renderer);
  std::vector<FramePtr> frames =
      bench::renderViews(renderer, kViewsPerTurn, kViewsBefore + kViewsTimed);
  std::vector<cv::Mat> masks;  // one a frame

  World() {
    const EmptyTableMask mask(calibration, empty_table);
    for (const FramePtr& frame : frames) masks.push_back(mask.maskOf(*frame));
  }
};

const World& world() {
  static const World kWorld;
  return kWorld;
}

// The best features of the first view and roughly where the second has them.
std::vector<KltMove> movesToSecondView(const TrackOptions& options) {
  const Renderer& renderer = world().renderer;
  const Calibration& calibration = world().calibration;
  const cv::Mat grey = greyOf(world().frames[0]->image_bgr);
  const cv::Mat allowed = allowedArea(world().masks[0], options);
  const auto truth = renderer.truePixels(0, TableLoad::kObject);
  const std::int64_t steps = bench::stepsTo(renderer.rig(), 1, kViewsPerTurn);
  const Rigid3 cam_from_table =
      camFromTable(*calibration.cam_from_table, trueAngleRad(renderer.rig(), steps));
  Random random(1);
  std::vector<KltMove> moves;
  for (const Feature& feature :
       detectFeatures(grey, estimateNoiseSigma(grey, allowed), allowed, {}, options)) {
    const Eigen::Vector2d whole = feature.pixel.array().round();
    const auto index = static_cast<std::size_t>(whole.y()) * static_cast<std::size_t>(grey.cols) +
                       static_cast<std::size_t>(whole.x());
    if (truth[index].surface != TruePixel::Surface::kObject) continue;
    const Eigen::Vector3d point_in_table = truth[index].point_in_table.cast<double>();
    const auto pixel = calibration.camera.project(cam_from_table * point_in_table);
    if (!pixel) continue;
    const Eigen::Vector2d off(random.uniform(-kPredictedWithin_px, kPredictedWithin_px),
                              random.uniform(-kPredictedWithin_px, kPredictedWithin_px));
    moves.push_back(
        {feature.pixel.cast<float>(), (*pixel + feature.pixel - whole + off).cast<float>()});
  }
  return moves;
}

benchmark::Counter secondsEach(double count) {
  return {count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

// By one thread. There and back on two levels of the pyramid: four levels a feature.
void followByKlt(benchmark::State& state) {
  const TrackOptions options;
  const GreyPyramid first = buildGreyPyramid(world().frames[0]->image_bgr, options.window_px);
  const GreyPyramid second = buildGreyPyramid(world().frames[1]->image_bgr, options.window_px);
  const auto moves = movesToSecondView(options);
  cv::setNumThreads(1);
  std::vector<KltOutcome> outcomes;
  for (auto _ : state) outcomes = kltStep(first, second, moves, options.window_px);
  cv::setNumThreads(-1);
  double found = 0.0;
  for (const KltOutcome& each : outcomes) {
    found += each.found && each.round_trip_px <= options.max_round_trip_px ? 1.0 : 0.0;
  }
  const auto features = static_cast<double>(moves.size());
  state.counters["features"] = features;
  state.counters["found"] = found / features;
  state.counters["s_per_feature_level"] = secondsEach(4.0 * features);
}
BENCHMARK(followByKlt)->Unit(benchmark::kMillisecond);

// By one thread. What holds a feature in its place after KLT.
void alignToReference(benchmark::State& state) {
  const TrackOptions options;
  const cv::Mat first = greyOf(world().frames[0]->image_bgr);
  const cv::Mat second = greyOf(world().frames[1]->image_bgr);
  std::vector<ReferencePatch> patches;
  std::vector<PatchPlace> starts;
  for (const KltMove& move : movesToSecondView(options)) {
    auto patch = ReferencePatch::cut(first, move.from.cast<double>(), options.window_px);
    if (!patch) continue;
    patches.push_back(std::move(*patch));
    starts.push_back({move.predicted.cast<double>()});
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
      benchmark::DoNotOptimize(patches[i].align(second, starts[i]));
    }
  }
  state.counters["features"] = static_cast<double>(patches.size());
  state.counters["s_per_feature"] = secondsEach(static_cast<double>(patches.size()));
}
BENCHMARK(alignToReference)->Unit(benchmark::kMillisecond);

// Argument: feature spacing in px, for about 500, 2000 and 10000 features. All cores.
void viewByView(benchmark::internal::Benchmark* benchmark) {
  for (const int spacing_px : {24, 10, 4}) benchmark->Arg(spacing_px);
  benchmark->Iterations(kViewsTimed)->UseRealTime()->MeasureProcessCPUTime();
  benchmark->Unit(benchmark::kMillisecond);
}

TrackOptions spacedBy(const benchmark::State& state) {
  TrackOptions options;
  options.feature_spacing_px = static_cast<int>(state.range(0));
  return options;
}

// Each iteration is a view; the views before are not timed.
template <class AddFrame>
void timeViews(benchmark::State& state, const AddFrame& add_frame) {
  std::size_t view = 0;
  for (; view < kViewsBefore; ++view) add_frame(view);
  double features = 0.0;
  for (auto _ : state) features += static_cast<double>(add_frame(view++).marks.size());
  state.counters["features"] = features / kViewsTimed;
  state.counters["frames_per_s"] = benchmark::Counter(kViewsTimed, benchmark::Counter::kIsRate);
}

// Masks are ready.
void trackView(benchmark::State& state) {
  FeatureTracker tracker =
      FeatureTracker::create(world().calibration, spacedBy(state), RecoverOptions{}).value();
  timeViews(state, [&](std::size_t view) {
    return tracker.addFrame(world().frames[view], world().masks[view]);
  });
}
BENCHMARK(trackView)->Apply(viewByView);

// With the masks, and the watch over camera and table.
void reconstructView(benchmark::State& state) {
  ReconstructOptions options;
  options.track = spacedBy(state);
  LiveReconstruction live =
      LiveReconstruction::create(world().calibration, world().empty_table, options).value();
  timeViews(state, [&](std::size_t view) { return live.addFrame(world().frames[view]).value(); });
}
BENCHMARK(reconstructView)->Apply(viewByView);

}  // namespace
}  // namespace gyre

BENCHMARK_MAIN();
