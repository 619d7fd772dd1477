// From where the pictures of a result were taken.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/posed_camera.h"

namespace gyre {

struct ResultView {
  std::string picture;   // its file's name, after "pass-2/" and the like in a merged result
  PosedCamera camera;    // in the table frame; of a merged result, that of its first pass
  std::size_t pass = 0;  // 0 unless the result is merged of several
};
using ResultViews = std::vector<ResultView>;  // in the order in which points name them

// By calibration.json and angles_solved.csv in a result's folder, or, where passes.json says that
// it is merged of several passes, by those of each pass. Fails when one of them is missing or
// cannot be read, and when a calibration does not say where the table is.
Result<ResultViews> readResultViews(const std::filesystem::path& folder);

// Whether the files are there that readResultViews() reads.
bool hasResultViews(const std::filesystem::path& folder);

std::vector<PosedCamera> camerasOf(const ResultViews& views);

}  // namespace gyre
