// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scan/picture_size.h"

namespace gyre {

std::string PictureSize::text() const {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

Result<void> checkCalibratedSize(const PictureSize& size, const CameraModel& calibrated,
                                 const std::string& subject_has) {
  const PictureSize calibrated_size{calibrated.width_px, calibrated.height_px};
  if (size == calibrated_size) return {};
  return Error{
      Error::Code::kInvalidInput,
      subject_has + " " + size.text() + " pixels, the calibration was made at " +
          calibrated_size.text() + ".",
      "Use the camera mode that was calibrated and its pictures as they came, or calibrate "
      "at this size."};
}

}  // namespace gyre
