// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/rendered_turn.h"

#include <memory>
#include <utility>

#include "core/base/units.h"

namespace gyre::bench {

std::int64_t stepsTo(const RigSettings& rig, int view, int views_per_turn) {
  return static_cast<std::int64_t>(rig.steps_per_turn) * view / views_per_turn;
}

std::vector<FramePtr> renderViews(const Renderer& renderer, int views_per_turn, int views) {
  std::vector<FramePtr> rendered;
  for (int view = 0; view < views; ++view) {
    const std::int64_t steps = stepsTo(renderer.rig(), view, views_per_turn);
    Frame frame = renderer.render(steps, TableLoad::kObject);
    frame.view = view;
    frame.table_angle_rad = kTurn_rad * static_cast<double>(steps) / renderer.rig().steps_per_turn;
    rendered.push_back(std::make_shared<const Frame>(std::move(frame)));
  }
  return rendered;
}

std::vector<FramePtr> everyNth(const std::vector<FramePtr>& views, std::size_t n) {
  std::vector<FramePtr> thinned;
  for (std::size_t i = 0; i < views.size(); i += n) {
    Frame frame = *views[i];
    frame.view = static_cast<int>(thinned.size());
    thinned.push_back(std::make_shared<const Frame>(std::move(frame)));
  }
  return thinned;
}

FramePtr renderEmptyTable(const Renderer& renderer) {
  return std::make_shared<const Frame>(renderer.render(0, TableLoad::kEmpty));
}

}  // namespace gyre::bench
