// Reads and writes sightings.bin: where each point was seen, pixel by pixel.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scan/track.h"

namespace gyre {

// Of each point of points.ply, in its order; views as in visibility.bin.
using PointSightings = std::vector<std::vector<Observation>>;

// For each point: u32 n, then n x (u32 view index, float x, float y): raw (distorted) pixels, the
// centre of the first one is (0, 0). Little endian.
std::string sightingsBytes(const PointSightings& sightings);

// Replaces the file atomically.
Result<void> writeSightings(const std::filesystem::path& file, const PointSightings& sightings);

// Fails when the file is not about exactly so many points, or holds a pixel that is no number. The
// sightings' sigma_px is not in the file and stays at its default.
Result<PointSightings> readSightings(const std::filesystem::path& file, std::size_t points);

// The same from the file's bytes. file: what the sentences call it.
Result<PointSightings> parseSightings(std::string_view bytes, const std::string& file,
                                      std::size_t points);

}  // namespace gyre
