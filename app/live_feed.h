// Reconstructs in a thread of its own while the scan goes on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/live_reconstruction.h"
#include "core/scan/frame.h"
#include "core/scan/point_cloud.h"
#include "core/scan/tracked_frame.h"

namespace gyre {

// One thread pushes and finishes.
class LiveFeed {
 public:
  // Called in the feed's thread after each frame, with the points so far.
  using Watcher = std::function<void(TrackedFrame frame, const PointCloudPtr& cloud)>;

  explicit LiveFeed(LiveReconstruction reconstruction, Watcher watcher = {});
  ~LiveFeed();  // what still waits is dropped
  LiveFeed(const LiveFeed&) = delete;
  LiveFeed& operator=(const LiveFeed&) = delete;

  // Waits while four frames are waiting, and with it the table, so that memory stays bounded. After
  // a failure frames are dropped: the scan goes on, and finish() tells.
  void push(const FramePtr& frame);

  std::size_t pointsSoFar() const;
  // The view at which the camera was first seen bumped.
  std::optional<int> bumpedView() const;

  // Waits for the frames that wait and gives the final points, or why there are none.
  Result<Reconstruction> finish(const Task& task);

 private:
  void run(const std::stop_token& stop);
  Result<std::size_t> addFrame(const FramePtr& frame);  // gives the points so far

  const Watcher watcher_;
  LiveReconstruction reconstruction_;  // of the thread, until it is idle in finish()
  std::size_t frames_ = 0;             // likewise
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<FramePtr> waiting_;
  bool working_ = false;
  std::size_t points_ = 0;
  std::optional<int> bumped_view_;
  std::optional<Error> failure_;
  std::jthread thread_;  // last: it must stop before the rest goes
};

}  // namespace gyre
