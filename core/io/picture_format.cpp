// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/picture_format.h"

#include <limits>

namespace gyre {
namespace {

using std::string_view_literals::operator""sv;

constexpr auto kPngSignature = "\x89PNG\r\n\x1a\n"sv;

enum class Order : std::uint8_t { kBig, kLittle };

// The unsigned number of so many bytes at the offset; nothing beyond the end.
std::optional<std::uint32_t> numberAt(std::string_view bytes, std::uint64_t offset, unsigned width,
                                      Order order) {
  if (offset > bytes.size() || bytes.size() - offset < width) return std::nullopt;
  std::uint32_t number = 0;
  for (unsigned i = 0; i < width; ++i) {
    const unsigned place = order == Order::kBig ? i : width - 1 - i;
    number = (number << 8U) | static_cast<unsigned char>(bytes[offset + place]);
  }
  return number;
}

// A header with this size, or nothing when a side is missing, zero or does not fit an int.
std::optional<PictureHeader> headerOf(PictureFormat format, std::optional<std::uint32_t> width,
                                      std::optional<std::uint32_t> height) {
  constexpr auto kMax = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
  if (!width || !height || *width == 0 || *height == 0) return std::nullopt;
  if (*width > kMax || *height > kMax) return std::nullopt;
  return PictureHeader{format, static_cast<int>(*width), static_cast<int>(*height), false};
}

// Chunks: u32 length, 4 letters, that many bytes, u32 checksum. The last is IEND.
std::optional<PictureHeader> inspectPng(std::string_view bytes) {
  auto header = headerOf(PictureFormat::kPng, numberAt(bytes, 16, 4, Order::kBig),
                         numberAt(bytes, 20, 4, Order::kBig));
  if (!header) return std::nullopt;
  for (std::uint64_t at = kPngSignature.size(); at + 12 <= bytes.size();) {
    const std::uint64_t length = *numberAt(bytes, at, 4, Order::kBig);
    if (bytes.substr(at + 4, 4) == "IEND") header->whole = true;
    at += 12 + length;
  }
  return header;
}

bool isStartOfFrame(std::uint32_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Where the entropy-coded bytes end: at a marker that is neither a stuffed zero nor a restart.
std::uint64_t endOfScan(std::string_view bytes, std::uint64_t at) {
  for (; at + 1 < bytes.size(); ++at) {
    const auto next = static_cast<unsigned char>(bytes[at + 1]);
    const bool restart = next >= 0xD0 && next <= 0xD7;
    if (bytes[at] == '\xFF' && next != 0 && next != 0xFF && !restart) return at;
  }
  return bytes.size();
}

// Segments: FF, marker, u16 length with itself. SOFn holds the size, SOS is followed by the scan,
// EOI ends the picture; a thumbnail with its own EOI lies inside a segment and is passed over.
std::optional<PictureHeader> inspectJpeg(std::string_view bytes) {
  std::optional<PictureHeader> header;
  std::uint64_t at = 2;
  while (const auto marker = numberAt(bytes, at, 2, Order::kBig)) {
    const std::uint32_t code = *marker & 0xFFU;
    if (*marker == 0xFFFF) {  // fill byte
      ++at;
      continue;
    }
    if (*marker < 0xFF00) break;
    if (code == 0xD9) {
      if (header) header->whole = true;
      break;
    }
    const auto length = numberAt(bytes, at + 2, 2, Order::kBig);
    if (!length || *length < 2) break;
    if (isStartOfFrame(code) && !header) {
      header = headerOf(PictureFormat::kJpeg, numberAt(bytes, at + 7, 2, Order::kBig),
                        numberAt(bytes, at + 5, 2, Order::kBig));
    }
    at += 2 + *length;
    if (code == 0xDA) at = endOfScan(bytes, at);
  }
  return header;
}

std::optional<PictureHeader> inspectBmp(std::string_view bytes) {
  auto height = numberAt(bytes, 22, 4, Order::kLittle);
  if (height && *height > 0x7FFFFFFFU) height = 0U - *height;  // negative: rows from the top
  auto header = headerOf(PictureFormat::kBmp, numberAt(bytes, 18, 4, Order::kLittle), height);
  if (header) {
    const std::uint64_t size = *numberAt(bytes, 2, 4, Order::kLittle);
    header->whole = bytes.size() >= size;
  }
  return header;
}

// The first directory of a TIFF: entries of u16 tag, u16 type, u32 count, u32 value or its place.
class TiffDirectory {
 public:
  explicit TiffDirectory(std::string_view bytes)
      : bytes_(bytes), order_(bytes.starts_with('M') ? Order::kBig : Order::kLittle) {
    start_ = numberAt(bytes, 4, 4, order_).value_or(0);
    entries_ = numberAt(bytes, start_, 2, order_).value_or(0);
  }

  // The tag's i-th value.
  std::optional<std::uint32_t> value(std::uint32_t tag, std::uint32_t i = 0) const {
    for (std::uint64_t entry = 0; entry < entries_; ++entry) {
      const std::uint64_t at = start_ + 2 + 12 * entry;
      if (numberAt(bytes_, at, 2, order_) != tag) continue;
      const std::uint32_t width = numberAt(bytes_, at + 2, 2, order_) == 3U ? 2 : 4;
      const auto count = numberAt(bytes_, at + 4, 4, order_);
      if (!count || i >= *count) return std::nullopt;
      const bool inside = std::uint64_t{*count} * width <= 4;
      const auto place = inside ? at + 8 : numberAt(bytes_, at + 8, 4, order_).value_or(0);
      return numberAt(bytes_, place + std::uint64_t{i} * width, width, order_);
    }
    return std::nullopt;
  }

  // True when every piece of the picture, by the tags of offsets and byte counts, is in the file.
  bool holdsPieces(std::uint32_t offsets, std::uint32_t byte_counts) const {
    std::uint32_t i = 0;
    for (;; ++i) {
      const auto offset = value(offsets, i);
      const auto count = value(byte_counts, i);
      if (!offset || !count) return i > 0 && !offset && !count;
      if (std::uint64_t{*offset} + *count > bytes_.size()) return false;
    }
  }

 private:
  std::string_view bytes_;
  Order order_;
  std::uint64_t start_ = 0;
  std::uint64_t entries_ = 0;
};

std::optional<PictureHeader> inspectTiff(std::string_view bytes) {
  const TiffDirectory directory(bytes);
  auto header = headerOf(PictureFormat::kTiff, directory.value(256), directory.value(257));
  if (header) header->whole = directory.holdsPieces(273, 279) || directory.holdsPieces(324, 325);
  return header;
}

}  // namespace

std::optional<PictureHeader> inspectPicture(std::string_view bytes) {
  if (bytes.starts_with(kPngSignature)) return inspectPng(bytes);
  if (bytes.starts_with("\xFF\xD8\xFF"sv)) return inspectJpeg(bytes);
  if (bytes.starts_with("BM"sv)) return inspectBmp(bytes);
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return inspectTiff(bytes);
  return std::nullopt;
}

}  // namespace gyre
