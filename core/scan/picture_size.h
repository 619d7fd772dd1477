// How many pixels a picture has, and whether a calibration is for that many.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/geometry/camera_model.h"

namespace gyre {

struct PictureSize {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const PictureSize&) const = default;
  std::string text() const;  // "1280 x 960"
};

// Fails when the camera was calibrated with pictures of another size.
// subject_has: begins the sentence, such as "The pictures have".
Result<void> checkCalibratedSize(const PictureSize& size, const CameraModel& calibrated,
                                 const std::string& subject_has);

}  // namespace gyre
