// What gyre reconstruct is not told of camera and table, found in the pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "app/cli/console.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/options.h"
#include "core/pipeline/reconstruct.h"

namespace gyre {

struct UnknownRig {
  bool refine_camera = false;             // the calibration is only roughly known
  std::optional<double> known_length_mm;  // of the longest line through the object
};

// Finds what is missing, in the pictures' calibration and angles, and tells it on the console.
// Angles that nobody told get more freedom in the options. Fails when the pictures do not tell, and
// when stopped. Gives what was found in words, by what would have told it, for the report.
Result<std::map<std::string, std::string>> findUnknowns(const UnknownRig& rig,
                                                        PreparedPictures& prepared,
                                                        ReconstructOptions& options,
                                                        Console& console, const Task& task);

// Gives the model its size where a length is known, or where nothing tells its size. True when it
// has its true size.
bool giveSize(const UnknownRig& rig, bool calibrated, PreparedPictures& prepared,
              Reconstruction& model, Console& console);

}  // namespace gyre
