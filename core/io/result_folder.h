// A folder for results, made and tried before anything is computed for it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace gyre {

// Makes the folder and those above it where they are missing, and tries that a file can be written
// there: better told before minutes of work than after. Fails with kIo and a sentence. Thread: any.
Result<void> makeResultFolder(const std::filesystem::path& folder);

}  // namespace gyre
