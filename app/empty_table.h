// The picture of the bare table, by which the object is told from what it stands on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "app/rig.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/turntable.h"
#include "core/io/scan_store.h"
#include "core/scan/frame.h"

namespace gyre {

// A picture of the bare table that waits for its scan. The place holds however the table's angles
// are counted by then.
struct EmptyTable {
  FramePtr picture;
  TablePlace place;
};

// Takes the picture where the table stands. In a simulated room the object is taken off before and
// put on the table after.
Result<EmptyTable> pictureOfEmptyTable(const Rig& rig, const Task& task);

// Gives the picture to its scan, with the angle that its place has now. Returns false, and keeps
// nothing, when the table's angle was lost since: the picture then cannot be turned to the views.
Result<bool> keepEmptyTable(const EmptyTable& empty_table, const Turntable& turntable,
                            ScanStore& store);

// In a simulated room: takes the picture before the object is put on the table, once a scan, and
// then puts it there. Elsewhere, where nobody can move the object, it does nothing.
Result<void> takeEmptyTable(const Rig& rig, ScanStore& store, const Task& task);

// Keeps a picture that was taken beforehand: a file, or a folder (see readEmptyTable). Fails when
// its size is not the calibration's.
Result<void> keepEmptyTable(const std::filesystem::path& file_or_folder, ScanStore& store);

}  // namespace gyre
