// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scan_run.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/live_feed.h"
#include "core/base/clock.h"
#include "core/pipeline/acquire.h"

namespace gyre {
namespace {

// Feeds what was captured before this run at its place among what is captured now.
class OrderedFeed {
 public:
  OrderedFeed(LiveFeed& feed, const ScanStore& store)
      : feed_(feed), store_(store), earlier_(store.views()) {}

  void pushNew(const FramePtr& frame) {
    pushEarlierThan(frame->view);
    feed_.push(frame);
  }
  void pushRest() { pushEarlierThan(store_.settings().views); }

  const std::optional<Error>& failure() const { return failure_; }

 private:
  void pushEarlierThan(int view) {
    for (; next_ < earlier_.size() && earlier_[next_].view < view; ++next_) {
      const Result<FramePtr> frame = store_.readView(earlier_[next_]);
      if (frame) {
        feed_.push(*frame);
      } else if (!failure_) {
        failure_ = frame.error();
      }
    }
  }

  LiveFeed& feed_;
  const ScanStore& store_;
  const std::vector<CapturedView> earlier_;
  std::size_t next_ = 0;
  std::optional<Error> failure_;
};

Result<LiveReconstruction> startReconstruction(const ScanStore& store) {
  const Result<FramePtr> empty_table = store.readEmptyTable();
  if (!empty_table && empty_table.error().code != Error::Code::kNotFound) {
    return empty_table.error();
  }
  return LiveReconstruction::create(store.calibrationRecord(),
                                    empty_table ? *empty_table : nullptr);
}

// The task's reports with the number of points behind them, and a bump.
Task withPoints(const Task& task, const LiveFeed& feed) {
  return Task(task.stopToken(), [task, &feed](double fraction, std::string_view stage) {
    std::string text = std::string(stage) + ", " + std::to_string(feed.pointsSoFar()) + " points";
    if (const auto bumped = feed.bumpedView()) {
      text += ", camera or table were bumped at view " + std::to_string(*bumped + 1);
    }
    task.report(fraction, text);
  });
}

}  // namespace

Result<Reconstruction> runScan(Turntable& turntable, Camera& camera, ScanStore& store,
                               const Task& task) {
  return runScan(turntable, camera, store, ScanObserver{}, task);
}

Result<Reconstruction> runScan(Turntable& turntable, Camera& camera, ScanStore& store,
                               const ScanObserver& observer, const Task& task) {
  Result<LiveReconstruction> reconstruction = startReconstruction(store);
  if (!reconstruction) return reconstruction.error();
  LiveFeed feed(std::move(reconstruction).value(), observer.on_tracked);
  OrderedFeed ordered(feed, store);
  if (observer.on_begin) {
    observer.on_begin(static_cast<int>(store.views().size()), store.settings().views);
  }
  const double start_s = steadySeconds();
  std::size_t told = store.remarks().size();
  const auto acquired = acquire(
      turntable, camera, store,
      [&](const FramePtr& frame) {
        for (; told < store.remarks().size(); ++told) {
          if (observer.on_remark) observer.on_remark(store.remarks()[told].text);
        }
        ordered.pushNew(frame);
        if (observer.on_view) observer.on_view(frame, task);
      },
      withPoints(task.part(0.0, 0.9), feed));
  if (!acquired) return acquired.error();
  ordered.pushRest();
  if (observer.on_captured) observer.on_captured();
  const double acquired_s = steadySeconds() - start_s;
  // The motor has done its work; that it cannot be released does not spoil the scan.
  (void)turntable.release();
  if (ordered.failure()) return *ordered.failure();
  task.report(0.9, "Judging all points once more");
  Result<Reconstruction> points = feed.finish(task.part(0.9, 1.0));
  if (points) points->seconds["acquire"] = acquired_s;
  return points;
}

Result<Reconstruction> reconstructScan(const ScanStore& store, const Task& task) {
  Result<LiveReconstruction> reconstruction = startReconstruction(store);
  if (!reconstruction) return reconstruction.error();
  const auto total = std::to_string(store.views().size());
  int done = 0;
  for (const CapturedView& view : store.views()) {
    if (task.stopRequested()) return cancelled();
    task.report(0.9 * done / static_cast<double>(store.views().size()),
                "View " + std::to_string(done + 1) + " of " + total);
    ++done;
    const Result<FramePtr> frame = store.readView(view);
    if (!frame) return frame.error();
    if (const auto tracked = reconstruction->addFrame(*frame); !tracked) return tracked.error();
  }
  return reconstruction->finish(task.part(0.9, 1.0));
}

}  // namespace gyre
