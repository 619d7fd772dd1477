// Reads and writes silhouettes.bin: the object's outline in each view of a scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/silhouette.h"

namespace gyre {

// "GYRESIL1", u32 how many; for each: u32 view, u32 width, u32 height, then rows of bits, each row
// filled up to whole bytes, the first pixel in the lowest bit, 1 on the object. Little endian.
std::string silhouettesBytes(const Silhouettes& silhouettes);

// Replaces the file atomically.
Result<void> writeSilhouettes(const std::filesystem::path& file, const Silhouettes& silhouettes);

// Fails in a sentence on a file that is none, is cut off or holds absurd sizes.
Result<Silhouettes> readSilhouettes(const std::filesystem::path& file);

// The same from the file's bytes. file: what the sentences call it.
Result<Silhouettes> parseSilhouettes(std::string_view bytes, const std::string& file);

}  // namespace gyre
