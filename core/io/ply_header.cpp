// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ply_header.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace gyre {
namespace {

constexpr std::size_t kMaxElements = 64;
constexpr std::size_t kMaxProperties = 512;
constexpr std::size_t kMaxHeaderBytes = 1U << 20U;

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return words;
}

std::optional<PlyType> typeNamed(std::string_view name) {
  static constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::kI8},    {"int8", PlyType::kI8},     {"uchar", PlyType::kU8},
      {"uint8", PlyType::kU8},   {"short", PlyType::kI16},   {"int16", PlyType::kI16},
      {"ushort", PlyType::kU16}, {"uint16", PlyType::kU16},  {"int", PlyType::kI32},
      {"int32", PlyType::kI32},  {"uint", PlyType::kU32},    {"uint32", PlyType::kU32},
      {"float", PlyType::kF32},  {"float32", PlyType::kF32}, {"double", PlyType::kF64},
      {"float64", PlyType::kF64}};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

// Each of these takes one line of the header and returns false when it is malformed.

bool takeFormat(const std::vector<std::string_view>& words, PlyHeader& header) {
  if (words.size() != 3 || words[2] != "1.0") return false;
  if (words[1] == "ascii") {
    header.format = PlyFormat::kAscii;
  } else if (words[1] == "binary_little_endian") {
    header.format = PlyFormat::kLittleEndian;
  } else if (words[1] == "binary_big_endian") {
    header.format = PlyFormat::kBigEndian;
  } else {
    return false;
  }
  return true;
}

bool takeElement(const std::vector<std::string_view>& words, PlyHeader& header) {
  if (words.size() != 3 || header.elements.size() >= kMaxElements) return false;
  PlyElement element;
  element.name = words[1];
  const char* end = words[2].data() + words[2].size();
  const auto [stop, problem] = std::from_chars(words[2].data(), end, element.count);
  if (problem != std::errc{} || stop != end) return false;
  for (const PlyElement& other : header.elements) {
    if (other.name == element.name) return false;
  }
  header.elements.push_back(std::move(element));
  return true;
}

bool takeProperty(const std::vector<std::string_view>& words, PlyHeader& header) {
  const bool is_list = words.size() == 5 && words[1] == "list";
  if ((words.size() != 3 && !is_list) || header.elements.empty()) return false;
  PlyProperty property;
  property.name = words.back();
  const auto type = typeNamed(words[words.size() - 2]);
  if (!type) return false;
  property.type = *type;
  if (is_list) {
    property.list_length_type = typeNamed(words[2]);
    if (!property.list_length_type || *property.list_length_type >= PlyType::kF32) return false;
  }
  auto& properties = header.elements.back().properties;
  if (properties.size() >= kMaxProperties) return false;
  properties.push_back(std::move(property));
  return true;
}

bool takeLine(std::string_view line, bool& format_seen, PlyHeader& header) {
  const auto words = wordsOf(line);
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "format") {
    const bool first = !std::exchange(format_seen, true);
    return first && takeFormat(words, header);
  }
  if (words[0] == "element") return takeElement(words, header);
  if (words[0] == "property") return takeProperty(words, header);
  return false;
}

// The fewest bytes that one entry of the element takes.
std::uint64_t leastBytes(const PlyElement& element, PlyFormat format) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    // A number in a text takes a character and a blank; the blank after the last may be missing.
    bytes += format == PlyFormat::kAscii
                 ? 2
                 : plyTypeBytes(property.list_length_type.value_or(property.type));
  }
  return bytes;
}

bool bodyFits(const PlyHeader& header, std::size_t bytes_there) {
  std::uint64_t left = bytes_there + 1;
  for (const PlyElement& element : header.elements) {
    const std::uint64_t each = leastBytes(element, header.format);
    if (each == 0) continue;
    if (element.count > left / each) return false;
    left -= element.count * each;
  }
  return true;
}

}  // namespace

std::size_t plyTypeBytes(PlyType type) {
  static constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

Error badPly(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The PLY file \"" + file + "\" " + problem + ".",
          "Export it anew from the program that made it."};
}

Result<PlyHeader> parsePlyHeader(std::string_view bytes, const std::string& file) {
  PlyHeader header;
  bool format_seen = false;
  std::size_t at = 0;
  for (int number = 1;; ++number) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos || end > kMaxHeaderBytes) {
      return badPly(file, number == 1 ? "is no PLY file" : "has a header without an end");
    }
    const std::string_view line = trimmed(bytes.substr(at, end - at));
    at = end + 1;
    if (number == 1) {
      if (line != "ply") return badPly(file, "is no PLY file");
    } else if (line == "end_header") {
      break;
    } else if (!takeLine(line, format_seen, header)) {
      return badPly(file, "has a header that makes no sense in line " + std::to_string(number));
    }
  }
  if (!format_seen) return badPly(file, "does not tell its format");
  header.body_offset = at;
  if (!bodyFits(header, bytes.size() - at)) {
    return badPly(file, "is shorter than it announces: it is cut off");
  }
  return header;
}

}  // namespace gyre
