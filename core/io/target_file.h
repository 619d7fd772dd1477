// Reads and writes TARGET.json: what is known of a calibration target.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/target.h"

namespace gyre {

// Fails with a sentence on anything that no real target is: no points, numbers that are missing or
// absurd, ids that come twice, an unknown dictionary, markers that are no squares, faces that name
// unknown corners or are not flat to 0.5 mm, a base that is not on z = 0. Unknown keys are passed
// over; `page_axes` and `dots` may be absent.
Result<Target> readTarget(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<Target> parseTarget(std::string_view text, const std::string& file);

// The file's text; reading it gives the same target to the last bit.
std::string targetText(const Target& target);

// Replaces the file atomically. Refuses a target that readTarget() would refuse.
Result<void> writeTarget(const std::filesystem::path& file, const Target& target);

}  // namespace gyre
