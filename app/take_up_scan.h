// Takes up a scan that was left: finds where the table stands, and proves that all is as it was.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/rig.h"
#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/scan_store.h"

namespace gyre {

enum class TakeUp : std::uint8_t {
  kProve,  // goes on only when the pictures show that camera, table and object stand as they stood
  kTrust,  // somebody says so: what the pictures say against it becomes a remark
};

// A board's own count means nothing here: it may have been switched off, or turned by hand. One
// picture tells which captured view the camera sees; where it sees none, the object's features tell
// the angle, and the table is turned to the last captured view, whose picture must come out the
// same. Only for that the table is moved. With kTrust and nothing to be seen, the table is taken to
// stand at the last captured view.
//
// Gives what the user should know, a sentence each. kRejected, with what is not as it was: focus or
// zoom, camera, table or object.
Result<std::vector<std::string>> takeUpScan(const Rig& rig, const ScanStore& store, TakeUp how,
                                            const Task& task);

}  // namespace gyre
