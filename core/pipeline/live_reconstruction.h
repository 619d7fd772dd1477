// Turns frames into points while the table turns.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/options.h"
#include "core/pipeline/reconstruction.h"
#include "core/scan/calibration_record.h"
#include "core/scan/tracked_frame.h"

namespace gyre {

// Frames go in, in the order of their angles; after each of them the cloud so far can be asked
// for. The same frames give the same points, live or from files. One thread at a time.
class LiveReconstruction {
 public:
  // empty_table: a picture of the bare table, at its own angle, or null. A ring of markers by which
  // the rig was calibrated tells the angles (see PlatterRing). Fails when the calibration has no
  // cam_from_table, the empty table's picture has another size, or an option is out of
  // range.
  static Result<LiveReconstruction> create(const CalibrationRecord& calibration,
                                           const FramePtr& empty_table,
                                           const ReconstructOptions& options = {});

  LiveReconstruction(LiveReconstruction&&) noexcept;
  LiveReconstruction& operator=(LiveReconstruction&&) noexcept;
  ~LiveReconstruction();

  // Tracks into the frame and updates the points. Fails when the picture's size is not the
  // calibration's; the state is then unchanged. object_mask: 8 bit, above 127 on the object; an
  // empty one is made from the empty table, or from what does not turn.
  Result<TrackedFrame> addFrame(const FramePtr& frame, const cv::Mat& object_mask = {});

  // The points good enough so far, in the table frame, without normals.
  PointCloudPtr cloudSoFar() const;

  // The final points, with normals: every track estimated afresh from all its sightings and judged
  // against all masks. kCancelled when stopped; the state is then unchanged.
  Result<Reconstruction> finish(const Task& task) const;

 private:
  class Impl;
  explicit LiveReconstruction(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyre
