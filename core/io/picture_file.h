// Reads and writes one picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/io/picture_format.h"
#include "core/scan/frame.h"

namespace gyre {

// Size and format, without decoding. Fails when the file is no whole PNG, JPEG, BMP or TIFF.
Result<PictureHeader> inspectPictureFile(const std::filesystem::path& file);

// The picture as 8-bit BGR, as its pixels lie in the file: an EXIF rotation is ignored, grey
// becomes three equal channels, 16 bits become 8. The frame has the file's name and no view.
Result<Frame> readPicture(const std::filesystem::path& file);

// A mask, 8-bit single channel: 255 where the object is (above 127 in the file), 0 elsewhere.
Result<cv::Mat> readMask(const std::filesystem::path& file);

// The picture as the bytes of a PNG, lossless.
Result<std::string> pngBytes(const cv::Mat& image);

// The picture, 8 bits, as the bytes of a JPEG; quality from 1 to 100.
Result<std::string> jpegBytes(const cv::Mat& image, int quality);

// Replaces the file atomically with a lossless PNG.
Result<void> writePicture(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace gyre
