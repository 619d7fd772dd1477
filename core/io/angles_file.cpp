// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/angles_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "core/base/units.h"
#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = 64U << 20U;
constexpr double kMaxAngle_deg = 1e6;  // beyond it the angle within the turn loses its digits
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// Takes one cell, quoted or not, off the line. Nothing when a quotation mark is not closed or is
// followed by something else than a comma.
std::optional<std::string> takeCell(std::string_view& line) {
  line = trimmed(line);
  std::string cell;
  if (line.starts_with('"')) {
    std::size_t i = 1;
    for (; i < line.size(); ++i) {
      if (line[i] == '"' && line.substr(i + 1, 1) != "\"") break;
      if (line[i] == '"') ++i;  // two of them stand for one
      cell += line[i];
    }
    if (i >= line.size()) return std::nullopt;
    line = trimmed(line.substr(i + 1));
    if (!line.empty() && line.front() != ',') return std::nullopt;
  } else {
    cell = trimmed(line.substr(0, line.find(',')));
    line.remove_prefix(std::min(line.size(), line.find(',')));
  }
  return cell;
}

std::optional<std::vector<std::string>> cellsOf(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    const auto cell = takeCell(line);
    if (!cell) return std::nullopt;
    cells.push_back(*cell);
    if (line.empty()) return cells;
    line.remove_prefix(1);  // the comma
  }
}

std::optional<double> angleRad(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double angle_deg = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, angle_deg);
  if (problem != std::errc{} || stop != end) return std::nullopt;
  if (!std::isfinite(angle_deg) || std::abs(angle_deg) > kMaxAngle_deg) return std::nullopt;
  return radFromDeg(angle_deg);
}

Error badFile(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The angles file \"" + file + "\" " + problem + ".",
          "It needs a first line \"image,angle_deg\", then one line a picture, as in "
          "\"view_001.png,1.8\"."};
}

std::string quotedIfNeeded(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos && trimmed(name) == name) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// Returns what is wrong with the line, or nothing.
std::optional<std::string> addLine(std::string_view line, AngleList& angles,
                                   std::set<std::string>& named) {
  const auto cells = cellsOf(line);
  if (!cells || cells->size() != 2 || cells->front().empty()) {
    return "has something else than a name and a number";
  }
  const auto angle_rad = angleRad(cells->back());
  if (!angle_rad) return "has no usable angle (\"" + cells->back() + "\")";
  if (!named.insert(cells->front()).second) {
    return "names the picture \"" + cells->front() + "\" a second time";
  }
  angles.push_back({cells->front(), *angle_rad});
  return std::nullopt;
}

}  // namespace

Result<AngleList> parseAngleList(std::string_view text, const std::string& file) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  AngleList angles;
  std::set<std::string> named;
  bool header_seen = false;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    if (!header_seen) {
      if (cellsOf(line) != std::vector<std::string>{"image", "angle_deg"}) {
        return badFile(file, "does not begin with the line \"image,angle_deg\"");
      }
      header_seen = true;
      continue;
    }
    if (const auto problem = addLine(line, angles, named); problem) {
      return badFile(file, *problem + " in line " + std::to_string(number));
    }
  }
  if (angles.empty()) return badFile(file, "holds no angle");
  return angles;
}

Result<AngleList> readAngleList(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseAngleList(*text, file.string());
}

Result<AngleTable> parseAngles(std::string_view text, const std::string& file) {
  const auto list = parseAngleList(text, file);
  if (!list) return list.error();
  AngleTable angles;
  for (const auto& [picture, angle_rad] : *list) angles.emplace(picture, angle_rad);
  return angles;
}

Result<AngleTable> readAngles(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseAngles(*text, file.string());
}

Result<void> writeAngles(const std::filesystem::path& file, const AngleTable& angles) {
  AngleList list;
  for (const auto& [picture, angle_rad] : angles) list.push_back({picture, angle_rad});
  return writeAngleList(file, list);
}

Result<void> writeAngleList(const std::filesystem::path& file, const AngleList& angles) {
  std::string text = "image,angle_deg\n";
  for (const auto& [name, angle_rad] : angles) {
    text += quotedIfNeeded(name) + "," + jsonNumber(degFromRad(angle_rad)) + "\n";
  }
  return writeFileAtomically(file, text);
}

Result<std::vector<double>> anglesOfPictures(std::span<const std::filesystem::path> pictures,
                                             const AngleTable& angles) {
  std::vector<double> angles_rad;
  for (const std::filesystem::path& picture : pictures) {
    const auto found = angles.find(picture.filename().string());
    if (found == angles.end()) {
      return Error{Error::Code::kInvalidInput,
                   "There is no angle for the picture \"" + picture.filename().string() + "\".",
                   "Add a line for it to the angles file, or remove the picture."};
    }
    angles_rad.push_back(found->second);
  }
  const auto [least, most] = std::minmax_element(angles_rad.begin(), angles_rad.end());
  if (angles_rad.size() > 1 && *least == *most) {
    return Error{Error::Code::kInvalidInput, "All pictures have the same table angle.",
                 "Give the angle at which each picture was taken."};
  }
  return angles_rad;
}

}  // namespace gyre
