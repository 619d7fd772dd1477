// Whether a disk has room for a scan, before the scan begins.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/scan/picture_size.h"

namespace gyre {

// What so many noisy pictures of a size and the results made of them take. [bytes]
std::uintmax_t bytesForScan(int views, const PictureSize& size);

// Free on the disk on which the folder lies or would be made. Nothing when it cannot be told.
// [bytes]
std::optional<std::uintmax_t> freeBytesAt(const std::filesystem::path& folder);

// kNoSpace, with both numbers, when the disk on which the folder lies or would be made has fewer
// bytes free than wanted. Success when it cannot be told.
Result<void> checkFreeSpace(const std::filesystem::path& folder, std::uintmax_t wanted);

}  // namespace gyre
