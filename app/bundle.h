// Packs what somebody else needs to find out what went wrong with a scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

enum class BundlePictures : std::uint8_t { kLeaveOut, kInclude };

struct Bundled {
  std::size_t files = 0;
  std::size_t pictures = 0;  // among them
};

// The scan's settings, journal, calibration, report, angles and logs, the log of its turntable's
// wire as it was kept with the scan, or from the user's cache where it was cut off, and what
// program, system and devices there are; pictures and points only when they are asked for. The scan
// may be unfinished or damaged: what is there is packed. Nothing is left behind after a failure or
// a stop. scan: its folder or the .gyre file in it. out: .tar.gz or .zip.
Result<Bundled> writeBundle(const std::filesystem::path& scan, const std::filesystem::path& out,
                            BundlePictures pictures, const Task& task);

}  // namespace gyre
