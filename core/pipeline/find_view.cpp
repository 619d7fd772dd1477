// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_view.h"

#include "core/pipeline/settling.h"

namespace gyre {

Result<std::optional<CapturedView>> findView(const cv::Mat& picture_bgr, const ScanStore& store,
                                             const Task& task) {
  std::optional<CapturedView> found;
  std::size_t looked_at = 0;
  for (const CapturedView& view : store.views()) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(looked_at++) / static_cast<double>(store.views().size()),
                "Finding out where the table stands");
    const Result<FramePtr> frame = store.readView(view);
    if (!frame) return frame.error();
    if ((*frame)->image_bgr.size() != picture_bgr.size()) return std::optional<CapturedView>();
    if (somethingMoved((*frame)->image_bgr, picture_bgr)) continue;
    if (found) return std::optional<CapturedView>();
    found = view;
  }
  return found;
}

}  // namespace gyre
