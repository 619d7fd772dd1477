// Reads and writes visibility.bin: which views saw each point.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scan/point_cloud.h"

namespace gyre {

// For each point: u32 n, then n x u32 view index, little endian.
std::string visibilityBytes(const PointCloud& cloud);

// Replaces the file atomically.
Result<void> writeVisibility(const std::filesystem::path& file, const PointCloud& cloud);

// Sets the views of each point of the cloud. Fails, and leaves the cloud as it is, when the file
// is not about exactly so many points.
Result<void> readVisibility(const std::filesystem::path& file, PointCloud& cloud);

// The same from the file's bytes. file: what the sentences call it.
Result<void> parseVisibility(std::string_view bytes, const std::string& file, PointCloud& cloud);

}  // namespace gyre
