// What pictures of a target have shown so far, and why the others did not.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/calibrate.h"
#include "core/scan/target_view.h"

namespace gyre {

// Tells the watcher of each picture as it is added. One thread.
class Sightings {
 public:
  // pictures: how many there will be.
  Sightings(int pictures, const CalibrationWatcher& watcher)
      : pictures_(pictures), watcher_(watcher) {}

  // frame: null when the picture is on the disk and need not be shown.
  void found(const FramePtr& frame, TargetView view);
  void missed(const FramePtr& frame, const std::string& name, const Error& reason);

  // Fails with the reason that came most often.
  Result<void> checkEnough(std::size_t needed) const;

  std::vector<TargetView> views;
  std::vector<std::string> skipped;  // "007.png: reason"

 private:
  int pictures_;
  int number_ = 0;
  const CalibrationWatcher& watcher_;
  std::map<std::string, int> reasons_;
};

}  // namespace gyre
