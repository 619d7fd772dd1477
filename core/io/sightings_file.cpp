// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/sightings_file.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/little_endian.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{4} << 30U;
constexpr std::size_t kWord = 4;
constexpr std::size_t kSighting = 3 * kWord;
constexpr auto kMostViews = static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max());

Error notTheseSightings(const std::string& file) {
  return {Error::Code::kInvalidInput,
          "The file \"" + file + "\" does not belong to these points, or it is damaged.",
          "Reconstruct again, so that points and sightings are written together."};
}

}  // namespace

std::string sightingsBytes(const PointSightings& sightings) {
  std::string bytes;
  for (const auto& seen : sightings) {
    appendLittleEndian(bytes, static_cast<std::uint32_t>(seen.size()));
    for (const Observation& each : seen) {
      appendLittleEndian(bytes, static_cast<std::uint32_t>(each.view));
      appendLittleEndian(bytes, static_cast<float>(each.pixel.x()));
      appendLittleEndian(bytes, static_cast<float>(each.pixel.y()));
    }
  }
  return bytes;
}

Result<void> writeSightings(const std::filesystem::path& file, const PointSightings& sightings) {
  return writeFileAtomically(file, sightingsBytes(sightings));
}

Result<PointSightings> parseSightings(std::string_view bytes, const std::string& file,
                                      std::size_t points) {
  if (bytes.size() / kWord < points) return notTheseSightings(file);
  PointSightings sightings(points);
  for (auto& seen : sightings) {
    if (bytes.size() < kWord) return notTheseSightings(file);
    const auto count = littleEndianAt<std::uint32_t>(bytes.data());
    bytes.remove_prefix(kWord);
    if (bytes.size() / kSighting < count) return notTheseSightings(file);
    seen.resize(count);
    for (Observation& each : seen) {
      const auto view = littleEndianAt<std::uint32_t>(bytes.data());
      const auto x = littleEndianAt<float>(bytes.data() + kWord);
      const auto y = littleEndianAt<float>(bytes.data() + 2 * kWord);
      bytes.remove_prefix(kSighting);
      if (view > kMostViews || !std::isfinite(x) || !std::isfinite(y)) {
        return notTheseSightings(file);
      }
      each.view = static_cast<std::int32_t>(view);
      each.pixel = {x, y};
    }
  }
  if (!bytes.empty()) return notTheseSightings(file);
  return sightings;
}

Result<PointSightings> readSightings(const std::filesystem::path& file, std::size_t points) {
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  return parseSightings(*bytes, file.string(), points);
}

}  // namespace gyre
