// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/whole_jpeg.h"

#include <algorithm>
#include <climits>
#include <string>

#include <opencv2/imgcodecs.hpp>

namespace gyre {
namespace {

// Behind the end mark, cameras send line ends and fill words of zeros.
constexpr std::size_t kMostBehind = 64;

Error unusable(const std::string& why) {
  return {Error::Code::kIo, "A picture of the camera " + why + ".",
          "Check the connection, or choose a smaller picture in the camera's own settings."};
}

}  // namespace

bool isWholeJpeg(std::span<const unsigned char> bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return false;
  const std::size_t first = bytes.size() - std::min(kMostBehind, bytes.size());
  for (std::size_t at = bytes.size() - 2; at + 1 > first; --at) {
    if (bytes[at] == 0xff && bytes[at + 1] == 0xd9) return true;
    if (at == 0) break;
  }
  return false;
}

Result<cv::Mat> decodeWholeJpeg(std::span<const unsigned char> bytes) try {
  if (!isWholeJpeg(bytes)) return unusable("came in half");
  if (bytes.size() > INT_MAX) return unusable("is too large");
  const cv::Mat packet(1, static_cast<int>(bytes.size()), CV_8UC1,
                       const_cast<unsigned char*>(bytes.data()));
  cv::Mat image_bgr = cv::imdecode(packet, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (image_bgr.empty()) return unusable("could not be decoded");
  return image_bgr;
} catch (const cv::Exception& problem) {
  return unusable("could not be decoded: " + problem.err);
}

}  // namespace gyre
