// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/free_space.h"

#include <string>
#include <system_error>

#include "core/base/formatted.h"

namespace gyre {
namespace {

// Without loss a picture takes 1.6 bytes a pixel when its noise is 2 grey levels, 1.9 at 4, and
// this at 8, which few cameras reach in the light that a scan needs.
constexpr double kBytesPerPixel = 2.2;
// Room that is left for points, lines of sight and meshes.
constexpr std::uintmax_t kBytesForResults = 100'000'000;

std::string sizeText(std::uintmax_t bytes) {
  const auto exact = static_cast<double>(bytes);
  return exact < 1e9 ? formatted("%.0f MB", exact / 1e6) : formatted("%.1f GB", exact / 1e9);
}

}  // namespace

std::uintmax_t bytesForScan(int views, const PictureSize& size) {
  const double pixels = static_cast<double>(size.width_px) * size.height_px;
  return kBytesForResults + static_cast<std::uintmax_t>(kBytesPerPixel * pixels * views);
}

std::optional<std::uintmax_t> freeBytesAt(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::path place = std::filesystem::absolute(folder, problem);
  while (!std::filesystem::exists(place, problem) && place.has_relative_path()) {
    place = place.parent_path();
  }
  const std::filesystem::space_info space = std::filesystem::space(place, problem);
  if (problem || space.available == static_cast<std::uintmax_t>(-1)) return std::nullopt;
  return space.available;
}

Result<void> checkFreeSpace(const std::filesystem::path& folder, std::uintmax_t wanted) {
  const auto available = freeBytesAt(folder);
  if (!available || *available >= wanted) return {};
  return Error{Error::Code::kNoSpace,
               "The disk of \"" + folder.string() + "\" has " + sizeText(*available) +
                   " free; this scan may take " + sizeText(wanted) + ".",
               "Free some space, choose another disk, or ask for fewer views."};
}

}  // namespace gyre
