// Reads points whose places were measured, and where one picture shows them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scan/known_point.h"

namespace gyre {

// A line a point, "X Y Z u v": millimetres in a right-handed frame, then pixels (the centre of the
// first pixel is 0, 0), parted by blanks, tabs, commas or semicolons. Blank lines count for
// nothing, nor does what follows a #.
//
// Fails on a line that is not five finite numbers, which it names, and on fewer than seven points,
// from which no camera follows.
Result<std::vector<KnownPoint>> readPoints(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<std::vector<KnownPoint>> parsePoints(std::string_view text, const std::string& file);

}  // namespace gyre
