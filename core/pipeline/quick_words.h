// What the figures of a quick look mean, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "core/pipeline/object_extent.h"
#include "core/scan/quick_look.h"

namespace gyre {

enum class OutlinesKnown : std::uint8_t { kNo, kYes };

// Fills in verdicts, findings and faults from the figures of the views. Where the outlines are not
// known (no picture of the empty table) the object's place and texture are not judged.
void putIntoWords(OutlinesKnown outlines, const std::optional<ObjectExtent>& extent,
                  QuickLook& look);

}  // namespace gyre
