// Turns frames into points while the table turns.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/reconstruction.h"
#include "core/scan/calibration.h"
#include "core/scan/tracked_frame.h"

namespace gyre {

// Frames go in, in the order of their angles; after each of them the cloud so far can be asked
// for. The same frames give the same points, live or from files. One thread at a time.
class LiveReconstruction {
 public:
  // empty_table: a picture of the bare table at angle 0, or null. Fails when the calibration has
  // no cam_from_table.
  static Result<LiveReconstruction> create(const Calibration& calibration, FramePtr empty_table);

  LiveReconstruction(LiveReconstruction&&) noexcept;
  LiveReconstruction& operator=(LiveReconstruction&&) noexcept;
  ~LiveReconstruction();

  // Tracks into the frame and updates the points. Fails when the picture's size is not the
  // calibration's; the state is then unchanged.
  Result<TrackedFrame> addFrame(const FramePtr& frame);

  // The points accepted so far, in the table frame.
  PointCloudPtr cloudSoFar() const;

  // The final points: every track refined, weighed and judged once more.
  Result<Reconstruction> finish(const Task& task);

 private:
  class Impl;
  explicit LiveReconstruction(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyre
