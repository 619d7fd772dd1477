// Tells when a camera's controls leave the values at which they were locked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scan/device_info.h"

namespace gyre {

// Watches what was locked when the scan began; what could not be locked was told then. One thread.
class ControlWatch {
 public:
  explicit ControlWatch(std::vector<ControlState> at_start);

  // A sentence for each control that is not what it was when last looked at: its value changed, or
  // it is automatic again. Each change is told once.
  std::vector<std::string> look(const std::vector<ControlState>& now, int view);

 private:
  std::vector<ControlState> known_;
};

// Fails, with the reason, when focus or zoom were locked then and are not the same now: the
// calibration holds for one lens setting. What is not told is passed over.
Result<void> sameLens(const std::vector<ControlState>& then, const std::vector<ControlState>& now);

}  // namespace gyre
