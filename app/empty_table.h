// The picture of the bare table, by which the object is told from what it stands on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "app/rig.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/scan_store.h"

namespace gyre {

// In a simulated room: takes the picture before the object is put on the table, once a scan, and
// then puts it there. Elsewhere, where nobody can move the object, it does nothing.
Result<void> takeEmptyTable(const Rig& rig, ScanStore& store, const Task& task);

// Keeps a picture that was taken beforehand: a file, or the first picture of a folder.
Result<void> keepEmptyTable(const std::filesystem::path& file_or_folder, ScanStore& store);

}  // namespace gyre
