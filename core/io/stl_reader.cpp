// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/io/little_endian.h"
#include "core/io/model_builder.h"
#include "core/io/model_file.h"

namespace gyre {
namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of any kind, then the count of triangles
constexpr std::size_t kTriangleBytes = 50;

Error badStl(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The STL file \"" + file + "\" " + problem + ".",
          "Export it anew from the program that made it."};
}

using Corner = std::array<double, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t hash = 0;
    for (const double number : corner) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    return static_cast<std::size_t>(hash);
  }
};

// STL repeats a corner in every triangle: equal ones become one vertex again, so that triangles
// are neighbours.
class StlSurface {
 public:
  // Returns false when a number is none. A polygon with fewer than three different corners has no
  // area and is passed over.
  bool addFace(const std::vector<Corner>& corners) {
    indices_.clear();
    for (Corner corner : corners) {
      for (double& number : corner) {
        if (!std::isfinite(number)) return false;
        number += 0.0;  // -0 becomes 0, which equals it but has other bits
      }
      const auto next = static_cast<std::uint32_t>(builder_.vertices.size());
      const auto [found, is_new] = index_.try_emplace(corner, next);
      if (is_new) addVertex(corner);
      if (std::find(indices_.begin(), indices_.end(), found->second) == indices_.end()) {
        indices_.push_back(found->second);
      }
    }
    builder_.addFace(indices_);
    return true;
  }

  bool hasFaces() const { return builder_.hasFaces(); }
  ModelBuilder::Outcome finish() { return builder_.finish(); }

 private:
  void addVertex(const Corner& corner) {
    ModelVertex& entry = builder_.vertices.emplace_back();
    entry.vertex.position = {corner[0], corner[1], corner[2]};
    entry.vertex.rgb = kUncoloured;
  }

  ModelBuilder builder_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> index_;
  std::vector<std::uint32_t> indices_;
};

// What is wrong with the file, if anything is.
using Problem = std::optional<std::string>;

Problem readBinary(std::string_view bytes, StlSurface& surface) {
  if (bytes.size() < kHeaderBytes) return "is no STL file";
  const auto count = littleEndianAt<std::uint32_t>(bytes.data() + kHeaderBytes - 4);
  bytes.remove_prefix(kHeaderBytes);
  if (bytes.size() / kTriangleBytes < count) {
    return "is shorter than it announces: it is cut off, or no STL file";
  }
  std::vector<Corner> corners(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + kTriangleBytes * i + 3 * sizeof(float);  // past the normal
    for (Corner& corner : corners) {
      for (double& number : corner) {
        number = littleEndianAt<float>(at);
        at += sizeof(float);
      }
    }
    if (!surface.addFace(corners)) return "has a position that is no number";
  }
  return std::nullopt;
}

bool sameWord(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

// The words of a text file, one after the other.
class StlWords {
 public:
  explicit StlWords(std::string_view text) : text_(text), left_(text) {}

  // Empty at the end.
  std::string_view take() {
    constexpr std::string_view kBlank = " \t\r\n\f\v";
    left_.remove_prefix(std::min(left_.find_first_not_of(kBlank), left_.size()));
    const std::string_view word = left_.substr(0, left_.find_first_of(kBlank));
    left_.remove_prefix(word.size());
    return word;
  }

  bool takeIf(std::string_view lower) { return sameWord(take(), lower); }

  void skipLine() { left_.remove_prefix(std::min(left_.find('\n'), left_.size())); }

  // Where the last word stands, counted from 1.
  std::string line() const {
    const auto past = static_cast<std::ptrdiff_t>(text_.size() - left_.size());
    return std::to_string(1 + std::count(text_.begin(), text_.begin() + past, '\n'));
  }

 private:
  std::string_view text_;
  std::string_view left_;
};

bool takeCorner(StlWords& words, std::vector<Corner>& corners) {
  Corner& corner = corners.emplace_back();
  for (double& number : corner) {
    std::string_view word = words.take();
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* end = word.data() + word.size();
    const auto [stop, problem] = std::from_chars(word.data(), end, number);
    if (problem != std::errc{} || stop != end) return false;
  }
  return true;
}

// "normal x y z outer loop vertex x y z ... endloop endfacet". The normal is not looked at: the
// order of the corners tells it, and some programs write what is no number.
bool takeFacet(StlWords& words, std::vector<Corner>& corners) {
  corners.clear();
  if (!words.takeIf("normal")) return false;
  for (int i = 0; i < 3; ++i) words.take();
  if (!words.takeIf("outer") || !words.takeIf("loop")) return false;
  std::string_view word = words.take();
  for (; sameWord(word, "vertex"); word = words.take()) {
    if (!takeCorner(words, corners)) return false;
  }
  return sameWord(word, "endloop") && words.takeIf("endfacet") && corners.size() >= 3;
}

Problem readText(std::string_view text, StlSurface& surface) {
  StlWords words(text);
  std::vector<Corner> corners;
  bool inside = false;
  for (auto word = words.take(); !word.empty(); word = words.take()) {
    bool good = false;
    if (sameWord(word, inside ? "endsolid" : "solid")) {
      inside = !inside;
      words.skipLine();  // the solid's name, of any words
      good = true;
    } else if (inside && sameWord(word, "facet")) {
      good = takeFacet(words, corners);
      if (good && !surface.addFace(corners)) {
        return "has a position that is no number in line " + words.line();
      }
    }
    if (!good) return "makes no sense in line " + words.line();
  }
  if (inside) return "has no end: it is cut off";
  return std::nullopt;
}

// Many a binary file begins with "solid" too; but its length fits its count, and text has no NUL.
bool isText(std::string_view bytes) {
  if (!sameWord(StlWords(bytes).take().substr(0, 5), "solid")) return false;
  if (bytes.size() >= kHeaderBytes) {
    const auto count = littleEndianAt<std::uint32_t>(bytes.data() + kHeaderBytes - 4);
    if (bytes.size() - kHeaderBytes == kTriangleBytes * std::size_t{count}) return false;
  }
  return bytes.find('\0') == std::string_view::npos;
}

}  // namespace

Result<Model> parseStl(std::string_view bytes, const std::string& file) {
  StlSurface surface;
  const Problem problem = isText(bytes) ? readText(bytes, surface) : readBinary(bytes, surface);
  if (problem) return badStl(file, *problem);
  if (!surface.hasFaces()) return badStl(file, "holds no triangle");
  auto outcome = surface.finish();
  if (outcome.problem) return badStl(file, *outcome.problem);
  computeNormals(std::get<Mesh>(outcome.model));
  return std::move(outcome.model);
}

}  // namespace gyre
