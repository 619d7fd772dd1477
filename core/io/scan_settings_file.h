// Reads and writes NAME.gyre: what a scan was asked to be.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/scan.h"

namespace gyre {

// The most views that a scan may have.
inline constexpr int kMaxViews = 100'000;

// The .gyre file of a scan's folder: the one named as the folder, or the only one.
Result<std::filesystem::path> scanSettingsFileIn(const std::filesystem::path& folder);

Result<ScanSettings> readScanSettings(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<ScanSettings> parseScanSettings(std::string_view text, const std::string& file);

// The file's text, without the passwords in the camera's address. Fails when readScanSettings()
// would refuse it.
Result<std::string> scanSettingsText(const ScanSettings& settings);

}  // namespace gyre
