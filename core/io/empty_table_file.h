// The picture of the bare table, with the angle at which the table stood, on the disk.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/scan/frame.h"

namespace gyre {

// Writes empty.png, and its angle as angles.csv beside it, into the folder. The picture last: where
// there is one, its angle is known.
Result<void> writeEmptyTable(const std::filesystem::path& folder, const Frame& frame);

// Reads one picture, or a folder of them: their mean, which has less noise (of 16 at most). An
// angles.csv in the folder tells the table's angle; then only the pictures that were taken at the
// first one's angle count. Without it, the angle is 0: where the scan begins. kNotFound when there
// is no such file or no picture in the folder.
Result<FramePtr> readEmptyTable(const std::filesystem::path& file_or_folder);

}  // namespace gyre
