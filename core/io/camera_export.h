// What cameras of other programs have in common.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/geometry/camera_model.h"

namespace gyre {

// Where the centre of the first pixel is for programs that count from the picture's corner. [px]
inline constexpr double kPixelCentre = 0.5;

// Fails when leaving out the camera's skew would move a pixel by more than a tenth of one.
Result<void> checkSkew(const CameraModel& camera);

}  // namespace gyre
