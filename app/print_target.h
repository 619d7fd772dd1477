// Writes a calibration target as a PDF at true size, and its description beside it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/calib/targets/print_sheet.h"

namespace gyre {

// Writes NAME.pdf, one page at true size, and NAME.target.json in the folder, which is made when it
// is not there. Needs fonts and no screen: where no Qt application runs yet, one without a screen
// is started for as long as this takes, and then it must be the main thread; else any.
Result<void> printTarget(const StandardTarget& target, const PageSize& page,
                         const std::filesystem::path& folder);

}  // namespace gyre
