// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/picture_file.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = 1U << 30U;
constexpr std::int64_t kMaxPixels = 400'000'000;  // 1.2 GB as BGR
constexpr unsigned char kMaskThreshold = 127;

Error unreadable(const std::filesystem::path& file, const std::string& problem) {
  return {Error::Code::kInvalidInput,
          "The picture \"" + file.string() + "\" cannot be used: " + problem + ".",
          "Copy it anew from the camera, or remove it."};
}

Result<PictureHeader> inspectBytes(std::string_view bytes, const std::filesystem::path& file) {
  const auto header = inspectPicture(bytes);
  if (!header) return unreadable(file, "it is no PNG, JPEG, BMP or TIFF");
  if (!header->whole) return unreadable(file, "it is cut off before its end");
  if (std::int64_t{header->width_px} * header->height_px > kMaxPixels) {
    return unreadable(file, "it is too large");
  }
  return *header;
}

Result<cv::Mat> decode(const std::filesystem::path& file, int color_flag) {
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  if (const auto header = inspectBytes(*bytes, file); !header) return header.error();
  try {
    const std::vector<std::uint8_t> buffer(bytes->begin(), bytes->end());
    cv::Mat image = cv::imdecode(buffer, color_flag | cv::IMREAD_IGNORE_ORIENTATION);
    if (image.empty()) return unreadable(file, "it is damaged");
    return image;
  } catch (const cv::Exception&) {
    return unreadable(file, "it is damaged");
  }
}

Result<std::string> packed(const cv::Mat& image, const char* ending,
                           const std::vector<int>& parameters) {
  try {
    std::vector<std::uint8_t> buffer;
    if (cv::imencode(ending, image, buffer, parameters)) {
      return std::string(buffer.begin(), buffer.end());
    }
  } catch (const cv::Exception&) {  // told below
  }
  return Error{Error::Code::kInvalidInput, "A picture could not be packed as PNG or JPEG.",
               "It must have 8 or 16 bits and 1, 3 or 4 channels."};
}

}  // namespace

Result<PictureHeader> inspectPictureFile(const std::filesystem::path& file) {
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  return inspectBytes(*bytes, file);
}

Result<Frame> readPicture(const std::filesystem::path& file) {
  auto image = decode(file, cv::IMREAD_COLOR);
  if (!image) return image.error();
  Frame frame;
  frame.name = file.filename().string();
  frame.image_bgr = *std::move(image);
  return frame;
}

Result<cv::Mat> readMask(const std::filesystem::path& file) {
  const auto grey = decode(file, cv::IMREAD_GRAYSCALE);
  if (!grey) return grey.error();
  cv::Mat mask;
  cv::threshold(*grey, mask, kMaskThreshold, 255, cv::THRESH_BINARY);
  return mask;
}

Result<std::string> pngBytes(const cv::Mat& image) {
  // Level 1: twice the speed of the default for pictures that are a few per cent larger.
  return packed(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 1});
}

Result<std::string> jpegBytes(const cv::Mat& image, int quality) {
  return packed(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

Result<void> writePicture(const std::filesystem::path& file, const cv::Mat& image) {
  const auto bytes = pngBytes(image);
  if (!bytes) return bytes.error();
  return writeFileAtomically(file, *bytes);
}

}  // namespace gyre
