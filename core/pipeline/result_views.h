// From where the pictures of a result were taken.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid3.h"
#include "core/io/angles_file.h"
#include "core/scan/calibration.h"

namespace gyre {

struct ResultViews {
  Calibration calibration;  // with its cam_from_table
  AngleList angles;         // of each view, with its picture's name

  std::vector<Rigid3> camFromTable() const;  // of each view
};

// From calibration.json and angles_solved.csv in a result's folder. Fails when one of them is
// missing or cannot be read, and when the calibration does not say where the table is.
Result<ResultViews> readResultViews(const std::filesystem::path& folder);

}  // namespace gyre
