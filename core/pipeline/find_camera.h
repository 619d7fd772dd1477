// Camera and table of pictures that nobody calibrated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/pipeline/match_pictures.h"
#include "core/pipeline/reconstruct.h"

namespace gyre {

// Sets the calibration of the pictures from what they share (roughTurntable). Their angles are
// believed where they are told; else that they make one whole turn in steps much alike, which is
// refused where the last does not meet the first. The object, as far as spots show it, is then 100
// mm long and stands on z = 1.5, or on the platter at 0 where that is seen (scaleCalibration): its
// size is not told. Gives the number of matches that agree. Changes nothing when it fails: when the
// pictures do not tell, or the task is stopped.
Result<std::size_t> findCamera(PreparedPictures& prepared, const MatchedPictures& matched,
                               const Task& task);

// Turns the camera of a calibration that is roughly right (turnedCalibration). The angles are told,
// or found. Changes nothing when it fails.
Result<void> turnCamera(PreparedPictures& prepared, const MatchedPictures& matched,
                        const Task& task);

}  // namespace gyre
