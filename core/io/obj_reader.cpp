// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/io/model_builder.h"
#include "core/io/model_file.h"

namespace gyre {
namespace {

constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

Error badObj(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The OBJ file \"" + file + "\" " + problem + ".",
          "Export it anew from the program that made it."};
}

// Takes the next word off the line; empty at its end.
std::string_view takeWord(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

template <class Number>
bool parseWhole(std::string_view text, Number& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, number);
  return problem == std::errc{} && stop == end;
}

// The numbers of a line, eight at most; nothing when a word is none.
std::optional<std::vector<double>> numbersOf(std::string_view line) {
  std::vector<double> numbers;
  for (auto word = takeWord(line); !word.empty(); word = takeWord(line)) {
    double number = 0.0;
    if (numbers.size() == 8 || !parseWhole(word, number)) return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

std::uint8_t channelOf(double share) {
  return static_cast<std::uint8_t>(std::clamp(std::round(share * 255.0), 0.0, 255.0));
}

class ObjReader {
 public:
  // Returns false when the line is malformed; words that are not of shape are passed over.
  bool takeLine(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view word = takeWord(line);
    if (word == "v") return takeVertex(line);
    if (word == "vn") return takeNormal(line);
    if (word == "f") return takeFace(line);
    return true;
  }

  ModelBuilder::Outcome finish() { return builder_.finish(); }

 private:
  // "x y z", "x y z w", "x y z r g b" or "x y z w r g b"; colours in 0..1.
  bool takeVertex(std::string_view line) {
    const auto numbers = numbersOf(line);
    if (!numbers || numbers->size() < 3) return false;
    ModelVertex entry;
    entry.vertex.position = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    entry.vertex.rgb = kUncoloured;
    if (numbers->size() >= 6) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = (*numbers)[numbers->size() - 3 + i];
        if (!std::isfinite(share)) return false;
        entry.vertex.rgb[i] = channelOf(share);
      }
    }
    builder_.vertices.push_back(entry);
    return true;
  }

  bool takeNormal(std::string_view line) {
    const auto numbers = numbersOf(line);
    if (!numbers || numbers->size() != 3) return false;
    normals_.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    return true;
  }

  // Corners "v", "v/vt", "v//vn", "v/vt/vn"; counted from 1, or backwards from the last by -1.
  bool takeFace(std::string_view line) {
    corners_.clear();
    for (auto corner = takeWord(line); !corner.empty(); corner = takeWord(line)) {
      const std::size_t slash = corner.find('/');
      const std::uint32_t vertex = indexOf(corner.substr(0, slash), builder_.vertices.size());
      if (vertex == kNoIndex) return false;
      corners_.push_back(vertex);
      const std::size_t second = corner.find('/', std::min(slash, corner.size() - 1) + 1);
      if (slash == std::string_view::npos || second == std::string_view::npos) continue;
      const std::uint32_t normal = indexOf(corner.substr(second + 1), normals_.size());
      if (normal == kNoIndex) return false;
      // A vertex has one normal here; where faces disagree, as at creases, the last one stays.
      if (normal < normals_.size() && vertex < builder_.vertices.size()) {
        builder_.vertices[vertex].vertex.normal = normals_[normal];
      }
    }
    if (corners_.size() < 3) return false;
    builder_.addFace(corners_);
    return true;
  }

  // A face may name vertices that follow it: those are checked at the end.
  static std::uint32_t indexOf(std::string_view text, std::size_t count) {
    std::int64_t index = 0;
    if (!parseWhole(text, index) || index == 0) return kNoIndex;
    index = index > 0 ? index - 1 : index + static_cast<std::int64_t>(count);
    return index >= 0 && index < kNoIndex ? static_cast<std::uint32_t>(index) : kNoIndex;
  }

  ModelBuilder builder_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<std::uint32_t> corners_;
};

// Takes a line, joined with those that follow a backslash at its end.
std::string takeJoinedLine(std::string_view& text) {
  std::string joined;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const bool goes_on = line.ends_with('\\') && !text.empty();
    if (goes_on) line.remove_suffix(1);
    joined.append(line);
    if (!goes_on) return joined;
    joined.append(" ");
  }
}

}  // namespace

Result<Model> parseObj(std::string_view bytes, const std::string& file) {
  // A NUL byte is in no text: this is something else, or a disk lost its content.
  if (bytes.find('\0') != std::string_view::npos) return badObj(file, "is no OBJ file");
  ObjReader reader;
  for (std::string_view left = bytes; !left.empty();) {
    const auto offset = static_cast<std::ptrdiff_t>(bytes.size() - left.size());
    if (reader.takeLine(takeJoinedLine(left))) continue;
    const auto number = 1 + std::count(bytes.begin(), bytes.begin() + offset, '\n');
    return badObj(file, "makes no sense in line " + std::to_string(number));
  }
  auto outcome = reader.finish();
  if (outcome.problem) return badObj(file, *outcome.problem);
  return std::move(outcome.model);
}

}  // namespace gyre
