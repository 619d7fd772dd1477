// Finds out by a picture at which captured view the table stands.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/io/scan_store.h"

namespace gyre {

// The captured view that shows what the picture shows, but for noise. Nothing when no view does, or
// when several do: a plain round object looks the same from everywhere. Reads every picture of the
// scan. Fails when one cannot be read.
Result<std::optional<CapturedView>> findView(const cv::Mat& picture_bgr, const ScanStore& store,
                                             const Task& task);

}  // namespace gyre
