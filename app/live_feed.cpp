// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_feed.h"

#include <exception>
#include <string>
#include <utility>

namespace gyre {
namespace {

constexpr std::size_t kMostWaiting = 4;
constexpr std::size_t kFramesPerCount = 5;  // counting the points costs more than a glance

}  // namespace

LiveFeed::LiveFeed(LiveReconstruction reconstruction, Watcher watcher)
    : watcher_(std::move(watcher)), reconstruction_(std::move(reconstruction)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LiveFeed::~LiveFeed() = default;

void LiveFeed::push(const FramePtr& frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || waiting_.size() < kMostWaiting; });
  if (failure_) return;
  waiting_.push_back(frame);
  changed_.notify_all();
}

std::size_t LiveFeed::pointsSoFar() const {
  const std::scoped_lock lock(mutex_);
  return points_;
}

std::optional<int> LiveFeed::bumpedView() const {
  const std::scoped_lock lock(mutex_);
  return bumped_view_;
}

Result<Reconstruction> LiveFeed::finish(const Task& task) {
  {
    std::unique_lock lock(mutex_);
    const bool idle = changed_.wait(lock, task.stopToken(),
                                    [&] { return failure_ || (waiting_.empty() && !working_); });
    if (!idle) return cancelled();
    if (failure_) return *failure_;
  }
  return reconstruction_.finish(task);
}

void LiveFeed::run(const std::stop_token& stop) {
  while (true) {
    FramePtr frame;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [&] { return !waiting_.empty(); })) return;
      if (stop.stop_requested()) return;
      frame = std::move(waiting_.front());
      waiting_.pop_front();
      working_ = true;
      changed_.notify_all();
    }
    const Result<std::size_t> points = addFrame(frame);
    const std::scoped_lock lock(mutex_);
    working_ = false;
    changed_.notify_all();
    if (!points) {
      failure_ = points.error();
      return;
    }
    points_ = *points;
  }
}

Result<std::size_t> LiveFeed::addFrame(const FramePtr& frame) try {
  auto tracked = reconstruction_.addFrame(frame);
  if (!tracked) return tracked.error();
  if (tracked->drift.moved) {
    const std::scoped_lock lock(mutex_);
    if (!bumped_view_) bumped_view_ = tracked->drift.view;
  }
  if (watcher_) {
    const PointCloudPtr cloud = reconstruction_.cloudSoFar();
    watcher_(std::move(tracked).value(), cloud);
    return cloud->points.size();
  }
  if (frames_++ % kFramesPerCount != 0) return pointsSoFar();
  return reconstruction_.cloudSoFar()->points.size();
} catch (const std::exception& problem) {
  return Error{Error::Code::kInternal,
               std::string("The reconstruction failed inside: ") + problem.what() + ".",
               "The pictures are kept; `gyre reconstruct` can try again."};
}

}  // namespace gyre
