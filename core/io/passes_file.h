// Reads and writes passes.json: of which passes a merged result is made, and how they lie.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scan/scan_pass.h"

namespace gyre {

inline constexpr const char* kPassesFile = "passes.json";

// {"format": "gyre-passes", "version": 1, "passes": [{name, folder, views, merged_from_pass
// {rotation [[..]x3], translation_mm [..]}, fit null or {spots, spots_mm, overlap,
// residual_mm}}]}. A relative folder counts from that of the file. Fails in a sentence on anything
// malformed, and on a name that would lead out of the folder.
Result<std::vector<ScanPass>> readPasses(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<std::vector<ScanPass>> parsePasses(std::string_view text, const std::string& file);

// The file's text; reading it gives the same numbers to the last bit.
std::string passesText(const std::vector<ScanPass>& passes);

// Replaces the file atomically.
Result<void> writePasses(const std::filesystem::path& file, const std::vector<ScanPass>& passes);

}  // namespace gyre
