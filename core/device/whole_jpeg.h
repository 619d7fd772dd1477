// JPEG pictures from a wire, where a cut-off one must not pass for a picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "core/base/result.h"
#include "core/scan/frame.h"

namespace gyre {

// Starts as a JPEG and has the mark of its end, with at most a few fill bytes behind it.
bool isWholeJpeg(std::span<const unsigned char> bytes);

// The picture as 8-bit BGR, turned by no EXIF tag. kIo when it came in half or cannot be decoded:
// decoders show what they have of a picture and fill the rest with grey.
Result<cv::Mat> decodeWholeJpeg(std::span<const unsigned char> bytes);

}  // namespace gyre
