// Tells the formats of models by the endings of their files' names.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace gyre {

enum class ModelFormat : std::uint8_t { kPly, kObj, kStl, kThreeMf, kGlb };

// The format that the name's ending stands for, in capitals or not; nothing for any other ending.
std::optional<ModelFormat> modelFormatOf(const std::filesystem::path& file);

}  // namespace gyre
