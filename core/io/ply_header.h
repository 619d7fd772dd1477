// The head of a PLY file: which elements with which properties follow.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace gyre {

enum class PlyFormat : std::uint8_t { kAscii, kLittleEndian, kBigEndian };
enum class PlyType : std::uint8_t { kI8, kU8, kI16, kU16, kI32, kU32, kF32, kF64 };

std::size_t plyTypeBytes(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kF32;             // of the value, or of a list's items
  std::optional<PlyType> list_length_type;  // of the number before a list; none for one value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;  // in the order in which they follow
  std::size_t body_offset = 0;       // where they begin
};

// Why a PLY file cannot be read.
Error badPly(const std::string& file, const std::string& problem);

// Fails on anything that is no PLY header, and when the file is too short for what it announces:
// counts may be trusted afterwards. file: what the sentences call it.
Result<PlyHeader> parsePlyHeader(std::string_view bytes, const std::string& file);

}  // namespace gyre
