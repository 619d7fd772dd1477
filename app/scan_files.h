// What a captured and reconstructed scan leaves in its folder, and how it is told.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/scan_store.h"
#include "core/pipeline/reconstruction.h"
#include "core/pipeline/write_results.h"

namespace gyre {

// writeResults() for a scan, into its own folder, with angles.csv beside.
Result<WrittenResults> writeScanResults(const ScanStore& store,
                                        const Reconstruction& reconstruction, const Task& task);

// Whether the scan has been reconstructed already.
bool hasResults(const ScanStore& store);

}  // namespace gyre
