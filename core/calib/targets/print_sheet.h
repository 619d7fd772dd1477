// A whole printed page: a target's net with its title, instructions and the rulers of both ways.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "core/calib/targets/standard_targets.h"

namespace gyre {

struct PageSize {
  std::string_view name;  // "A4"
  double width_mm = 0.0;
  double height_mm = 0.0;
};

inline constexpr PageSize kA4{"A4", 210.0, 297.0};
inline constexpr PageSize kLetter{"Letter", 215.9, 279.4};
inline constexpr double kRuler_mm = 100.0;

// "a4" or "letter", in any case of letters; nothing for other words.
std::optional<PageSize> pageSize(std::string_view word);

// The page, upright, in mm from its upper left corner. Every standard target fits both pages with
// at least 8 mm of rim, which printers leave white. The rulers: first right, then down.
PrintDrawing sheetOf(const StandardTarget& target, const PageSize& page);

}  // namespace gyre
