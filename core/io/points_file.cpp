// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/points_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/io/file_bytes.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = 64U << 20U;
constexpr std::size_t kLeastPoints = 7;
constexpr std::string_view kBlank = " \t\r,;";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view takeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0.0;
  const char* end = word.data() + word.size();
  const auto [stop, problem] = std::from_chars(word.data(), end, number);
  if (problem != std::errc{} || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

Error badFile(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The points file \"" + file + "\" " + problem + ".",
          "It needs a line a point, \"X Y Z u v\": millimetres, then pixels, as in "
          "\"10 30 0 123.79 122.55\"."};
}

// Five numbers and nothing else, or nothing.
std::optional<KnownPoint> pointOf(std::string_view line) {
  std::array<double, 5> numbers{};
  for (double& number : numbers) {
    const auto read = numberOf(takeWord(line));
    if (!read) return std::nullopt;
    number = *read;
  }
  if (!takeWord(line).empty()) return std::nullopt;
  KnownPoint point;
  point.position_in_target = {numbers[0], numbers[1], numbers[2]};
  point.pixel = {numbers[3], numbers[4]};
  return point;
}

}  // namespace

Result<std::vector<KnownPoint>> parsePoints(std::string_view text, const std::string& file) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<KnownPoint> points;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(kBlank) == std::string_view::npos) continue;
    const auto point = pointOf(line);
    if (!point) {
      return badFile(file,
                     "has something else than five numbers in line " + std::to_string(number));
    }
    points.push_back(*point);
  }
  if (points.size() < kLeastPoints) {
    return Error{Error::Code::kTooFew,
                 "The points file \"" + file + "\" holds " + std::to_string(points.size()) +
                     " points; a camera needs at least 7.",
                 "Add more points that spread in all directions."};
  }
  return points;
}

Result<std::vector<KnownPoint>> readPoints(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parsePoints(*text, file.string());
}

}  // namespace gyre
