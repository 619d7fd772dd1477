// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "core/calib/rig/rig_bundle.h"

namespace gyre {

Result<void> RigBundleOptions::validate() const {
  const auto refuse = [](const char* what) -> Result<void> {
    return Error{Error::Code::kInvalidInput, what, "Correct the calibration's options."};
  };
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (image_width_px < 1 || image_height_px < 1) return refuse("The pictures have no size.");
  if (fixed_camera &&
      (fixed_camera->width_px != image_width_px || fixed_camera->height_px != image_height_px)) {
    return Error{Error::Code::kInvalidInput,
                 "The given intrinsics belong to pictures of another size.",
                 "Give those of this camera in this mode."};
  }
  if (free.radial_terms < 0 || free.radial_terms > 3) {
    return refuse("The lens can have 0 to 3 radial terms.");
  }
  if (!positive(angle_prior_rad) || !positive(fold_sigma_rad) || !positive(fold_sigma_mm) ||
      !positive(object_size_mm) || !positive(ruler_mm) || !positive(printer_sigma) ||
      !object_middle_in_table.allFinite()) {
    return refuse("A length or standard deviation is not above zero.");
  }
  if (caliper_sigma_mm && !positive(*caliper_sigma_mm)) {
    return refuse("The caliper's standard deviation is not above zero.");
  }
  if (!(outlier_sigma > 2.0)) return refuse("Outliers begin above 2 standard deviations.");
  if (!positive(min_arc_rad) || !positive(max_median_px)) {
    return refuse("A limit of the calibration is not above zero.");
  }
  return {};
}

}  // namespace gyre
