// Replaces files so that every reader, and every crash, finds the old content or the new.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"

namespace gyre {

// Writes beside the file, syncs, renames over it and syncs the folder: when this returns success,
// the content survives a power cut. On failure the file is as it was and nothing is left beside it.
Result<void> writeFileAtomically(const std::filesystem::path& file, std::string_view bytes);

// Writes the folder's own entries to the disk: after files in it were made or renamed.
Result<void> syncFolder(const std::filesystem::path& folder);

// Removes what a killed writeFileAtomically() left in the folder. Only for one who knows that no
// other program writes there.
void removeUnfinishedFiles(const std::filesystem::path& folder);

}  // namespace gyre
