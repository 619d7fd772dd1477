// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/silhouettes_file.h"

#include <utility>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/little_endian.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 30U;
constexpr std::string_view kMagic = "GYRESIL2";
constexpr std::uint32_t kMaxSide = 1U << 15U;
constexpr int kBits = 8;

Error notSilhouettes(const std::string& file) {
  return {Error::Code::kInvalidInput,
          "The file \"" + file + "\" does not hold silhouettes, or it is damaged.",
          "Reconstruct again; or remove the file, and the surface is made without outlines."};
}

std::size_t rowBytes(std::size_t width) { return (width + kBits - 1) / kBits; }

void appendMask(std::string& bytes, const cv::Mat& mask) {
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; x += kBits) {
      unsigned packed = 0;
      for (int bit = 0; bit < kBits && x + bit < mask.cols; ++bit) {
        if (row[x + bit] != 0) packed |= 1U << static_cast<unsigned>(bit);
      }
      bytes.push_back(static_cast<char>(packed));
    }
  }
}

cv::Mat maskFrom(const char* bytes, int width, int height) {
  cv::Mat mask(height, width, CV_8U);
  for (int y = 0; y < height; ++y) {
    auto* row = mask.ptr<std::uint8_t>(y);
    const char* from =
        bytes + static_cast<std::size_t>(y) * rowBytes(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
      const auto packed = static_cast<std::uint8_t>(from[x / kBits]);
      row[x] = ((packed >> static_cast<unsigned>(x % kBits)) & 1U) != 0 ? 255 : 0;
    }
  }
  return mask;
}

std::uint32_t takeWord(std::string_view& bytes) {
  const auto word = littleEndianAt<std::uint32_t>(bytes.data());
  bytes.remove_prefix(sizeof(word));
  return word;
}

}  // namespace

std::string silhouettesBytes(const Silhouettes& silhouettes) {
  std::string bytes(kMagic);
  appendLittleEndian(bytes, static_cast<std::uint32_t>(silhouettes.size()));
  for (const Silhouette& each : silhouettes) {
    appendLittleEndian(bytes, each.view);
    appendLittleEndian(bytes, static_cast<std::uint32_t>(each.mask.cols));
    appendLittleEndian(bytes, static_cast<std::uint32_t>(each.mask.rows));
    appendMask(bytes, each.mask);
  }
  return bytes;
}

Result<void> writeSilhouettes(const std::filesystem::path& file, const Silhouettes& silhouettes) {
  return writeFileAtomically(file, silhouettesBytes(silhouettes));
}

Result<Silhouettes> parseSilhouettes(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kWord = sizeof(std::uint32_t);
  if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + kWord) {
    return notSilhouettes(file);
  }
  bytes.remove_prefix(kMagic.size());
  const std::uint32_t count = takeWord(bytes);
  Silhouettes silhouettes;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (bytes.size() < 3 * kWord) return notSilhouettes(file);
    Silhouette each;
    each.view = takeWord(bytes);
    const std::uint32_t width = takeWord(bytes);
    const std::uint32_t height = takeWord(bytes);
    const bool sized = width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide;
    if (!sized || bytes.size() / rowBytes(width) < height) return notSilhouettes(file);
    if (!silhouettes.empty() && each.view <= silhouettes.back().view) return notSilhouettes(file);
    each.mask = maskFrom(bytes.data(), static_cast<int>(width), static_cast<int>(height));
    bytes.remove_prefix(rowBytes(width) * height);
    silhouettes.push_back(std::move(each));
  }
  if (!bytes.empty()) return notSilhouettes(file);
  return silhouettes;
}

Result<Silhouettes> readSilhouettes(const std::filesystem::path& file) {
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  return parseSilhouettes(*bytes, file.string());
}

}  // namespace gyre
