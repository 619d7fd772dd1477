// Whether a scan that was left may go on: table, object and camera by pictures, not by counters.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/scan_store.h"
#include "core/scan/frame.h"

namespace gyre {

struct StandsCheck {
  bool judged = false;   // there was enough to see
  bool same = false;     // all that was seen then is where it was
  std::string sentence;  // what has moved, or that nothing has
};

// Holds a picture against one of the same view that was taken before: what stands still, the table
// and the object on it must all be where they were. Small pieces of the earlier picture are looked
// for again (StillPatches); a twentieth of them may be covered or changed, by a person or a shadow.
// A motion of about a pixel at 640 pixels width is seen.
StandsCheck standsAsBefore(const cv::Mat& then_bgr, const cv::Mat& now_bgr);

// The table's angle in a picture, by what it shows of the object, from several captured views
// (matchSpots, turnSteps): to a tenth of a degree or so. Nothing when too few spots are found
// again, or when the views contradict each other by more than a degree. Some seconds.
Result<std::optional<double>> tableAngleIn(const cv::Mat& picture_bgr, const ScanStore& store,
                                           const Task& task);

}  // namespace gyre
