// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/track/turn_gap.h"

#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/track/correlation.h"
#include "core/track/klt_step.h"

namespace gyre {
namespace {

constexpr std::size_t kLeastFeatures = 10;

}  // namespace

std::optional<TurnGap> measureTurnGap(const TurnEnds& ends, std::span<const LateFeature> late,
                                      const TrackOptions& options) {
  std::vector<KltMove> moves;
  std::vector<double> mm_per_px;
  std::vector<std::size_t> of_late;
  for (std::size_t i = 0; i < late.size(); ++i) {
    const LateFeature& feature = late[i];
    const Eigen::Vector3d in_cam = ends.first_cam_from_table * feature.position_in_table;
    const auto pixel = ends.camera.project(in_cam);
    if (!pixel || !ends.camera.contains(*pixel, options.window_px)) continue;
    moves.push_back({feature.last_pixel.cast<float>(), pixel->cast<float>()});
    mm_per_px.push_back(in_cam.z() / ends.camera.fx);
    of_late.push_back(i);
  }
  const auto outcomes = kltStep(ends.last, ends.first, moves, options.window_px);
  std::vector<double> gaps_px;
  std::vector<double> gaps_mm;
  TurnGap gap;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (!outcomes[i].found || outcomes[i].round_trip_px > options.max_round_trip_px) continue;
    const auto was = samplePatch(ends.last.grey, moves[i].from.cast<double>());
    const auto is = samplePatch(ends.first.grey, outcomes[i].to.cast<double>());
    if (!was || !is || correlate(*was, *is) < options.min_correlation) continue;
    gaps_px.push_back((outcomes[i].to - moves[i].predicted).cast<double>().norm());
    gaps_mm.push_back(gaps_px.back() * mm_per_px[i]);
    gap.returned.push_back({of_late[i], outcomes[i].to.cast<double>()});
  }
  if (gaps_px.size() < kLeastFeatures) return std::nullopt;
  gap.features = gaps_px.size();
  gap.px = median(std::move(gaps_px));
  gap.mm = median(std::move(gaps_mm));
  return gap;
}

}  // namespace gyre
