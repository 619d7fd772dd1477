// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/visibility_file.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/little_endian.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30U;

Error notTheseViews(const std::string& file) {
  return {Error::Code::kInvalidInput,
          "The file \"" + file + "\" does not belong to these points, or it is damaged.",
          "Reconstruct again, so that points and views are written together."};
}

}  // namespace

std::string visibilityBytes(const PointCloud& cloud) {
  std::string bytes;
  for (const Point& point : cloud.points) {
    appendLittleEndian(bytes, static_cast<std::uint32_t>(point.views.size()));
    for (const std::uint32_t view : point.views) appendLittleEndian(bytes, view);
  }
  return bytes;
}

Result<void> writeVisibility(const std::filesystem::path& file, const PointCloud& cloud) {
  return writeFileAtomically(file, visibilityBytes(cloud));
}

Result<void> parseVisibility(std::string_view bytes, const std::string& file, PointCloud& cloud) {
  constexpr std::size_t kWord = sizeof(std::uint32_t);
  std::vector<std::vector<std::uint32_t>> views(cloud.points.size());
  for (auto& seen_by : views) {
    if (bytes.size() < kWord) return notTheseViews(file);
    const auto count = littleEndianAt<std::uint32_t>(bytes.data());
    bytes.remove_prefix(kWord);
    if (bytes.size() / kWord < count) return notTheseViews(file);
    seen_by.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      seen_by.push_back(littleEndianAt<std::uint32_t>(bytes.data()));
      bytes.remove_prefix(kWord);
    }
  }
  if (!bytes.empty()) return notTheseViews(file);
  for (std::size_t i = 0; i < views.size(); ++i) cloud.points[i].views = std::move(views[i]);
  return {};
}

Result<void> readVisibility(const std::filesystem::path& file, PointCloud& cloud) {
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  return parseVisibility(*bytes, file.string(), cloud);
}

}  // namespace gyre
