// A scan from an open rig to points: captured, kept and reconstructed at the same time.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "app/live_feed.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/camera.h"
#include "core/device/turntable.h"
#include "core/io/scan_store.h"
#include "core/pipeline/reconstruction.h"

namespace gyre {

// Who watches a scan: each is called where something has happened, or not set.
struct ScanObserver {
  // Before the first move, and when all views are reconstructed: what the user should know of the
  // rig, a sentence.
  std::function<void(const std::string& remark)> on_remark;
  // Before a scan is taken up and fails: what the pictures say against it (kRejected). Somebody who
  // knows better may take it up all the same, with TakeUp::kTrust.
  std::function<void(const Error& objection)> on_objection;
  // Before the first move: how many views are there already.
  std::function<void(int views_done, int views)> on_begin;
  // In the scan's thread, when a view is safe on the disk. May block: the table waits.
  std::function<void(const FramePtr& frame, const Task& task)> on_view;
  // In the reconstruction's thread, after each view, with the points so far.
  LiveFeed::Watcher on_tracked;
  // When all views are captured and only the reconstruction goes on.
  std::function<void()> on_captured;
};

// Captures what the store does not hold yet and reconstructs the whole scan, frames that were
// captured earlier included and in their order: a scan that was cut off and resumed gives the same
// points as one that was not. The motor is released at the end. On failure, and when stopped, what
// was captured stays in the store.
Result<Reconstruction> runScan(Turntable& turntable, Camera& camera, ScanStore& store,
                               const Task& task);
Result<Reconstruction> runScan(Turntable& turntable, Camera& camera, ScanStore& store,
                               const ScanObserver& observer, const Task& task);

// The same when all views are captured: no device is needed.
Result<Reconstruction> reconstructScan(const ScanStore& store, const Task& task);

}  // namespace gyre
