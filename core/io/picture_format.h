// Looks into the bytes of a picture file: how large it is, and whether its end is there.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace gyre {

enum class PictureFormat : std::uint8_t { kPng, kJpeg, kBmp, kTiff };

struct PictureHeader {
  PictureFormat format = PictureFormat::kPng;
  int width_px = 0;
  int height_px = 0;
  bool whole = false;  // the end is there: decoders fill what is missing with grey, silently
};

// Nothing when the bytes do not begin as a PNG, JPEG, BMP or TIFF with a size.
std::optional<PictureHeader> inspectPicture(std::string_view bytes);

}  // namespace gyre
