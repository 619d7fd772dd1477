// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/io/model_builder.h"
#include "core/io/model_file.h"
#include "core/io/ply_header.h"

namespace gyre {
namespace {

// Takes one number after the other off the body. After running dry or meeting something that is
// no number, failed() is true and every further number is 0.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view body, PlyFormat format) : left_(body), format_(format) {}

  bool failed() const { return failed_; }

  double take(PlyType type) {
    if (failed_) return 0.0;
    return format_ == PlyFormat::kAscii ? takeText() : takeBinary(type);
  }

  // The length of a list; 0 and failed() when the body cannot hold so many items.
  std::uint64_t takeLength(const PlyProperty& list) {
    const double length = take(*list.list_length_type);
    const std::size_t least = format_ == PlyFormat::kAscii ? 1 : plyTypeBytes(list.type);
    if (length < 0.0 || length != std::floor(length) ||
        length * static_cast<double>(least) > static_cast<double>(left_.size())) {
      failed_ = true;
    }
    return failed_ ? 0 : static_cast<std::uint64_t>(length);
  }

 private:
  template <class Number>
  Number raw() {
    std::array<char, sizeof(Number)> bytes{};
    std::copy_n(left_.begin(), bytes.size(), bytes.begin());
    if ((format_ == PlyFormat::kBigEndian) != (std::endian::native == std::endian::big)) {
      std::reverse(bytes.begin(), bytes.end());
    }
    left_.remove_prefix(bytes.size());
    return std::bit_cast<Number>(bytes);
  }

  double takeBinary(PlyType type) {
    if (left_.size() < plyTypeBytes(type)) {
      failed_ = true;
      return 0.0;
    }
    switch (type) {
      case PlyType::kI8:
        return raw<std::int8_t>();
      case PlyType::kU8:
        return raw<std::uint8_t>();
      case PlyType::kI16:
        return raw<std::int16_t>();
      case PlyType::kU16:
        return raw<std::uint16_t>();
      case PlyType::kI32:
        return raw<std::int32_t>();
      case PlyType::kU32:
        return raw<std::uint32_t>();
      case PlyType::kF32:
        return raw<float>();
      case PlyType::kF64:
        return raw<double>();
    }
    return 0.0;
  }

  double takeText() {
    const std::size_t start = std::min(left_.find_first_not_of(" \t\r\n"), left_.size());
    left_.remove_prefix(start);
    if (left_.starts_with('+')) left_.remove_prefix(1);
    double number = 0.0;
    const auto [stop, problem] = std::from_chars(left_.data(), left_.data() + left_.size(), number);
    left_.remove_prefix(static_cast<std::size_t>(stop - left_.data()));
    const bool ended = left_.empty() || std::strchr(" \t\r\n", left_.front()) != nullptr;
    if (problem != std::errc{} || !ended) failed_ = true;
    return failed_ ? 0.0 : number;
  }

  std::string_view left_;
  PlyFormat format_;
  bool failed_ = false;
};

enum class Role : std::uint8_t {
  kX,
  kY,
  kZ,
  kNx,
  kNy,
  kNz,
  kRed,
  kGreen,
  kBlue,
  kSigma,
  kViews,
  kSeen,
  kCovXx,
  kCovXy,
  kCovXz,
  kCovYy,
  kCovYz,
  kCovZz,
  kNone
};
constexpr std::size_t kRoles = static_cast<std::size_t>(Role::kNone) + 1;

Role roleOf(const std::string& name) {
  static constexpr std::pair<std::string_view, Role> kNames[] = {{"x", Role::kX},
                                                                 {"y", Role::kY},
                                                                 {"z", Role::kZ},
                                                                 {"nx", Role::kNx},
                                                                 {"ny", Role::kNy},
                                                                 {"nz", Role::kNz},
                                                                 {"red", Role::kRed},
                                                                 {"green", Role::kGreen},
                                                                 {"blue", Role::kBlue},
                                                                 {"r", Role::kRed},
                                                                 {"g", Role::kGreen},
                                                                 {"b", Role::kBlue},
                                                                 {"diffuse_red", Role::kRed},
                                                                 {"diffuse_green", Role::kGreen},
                                                                 {"diffuse_blue", Role::kBlue},
                                                                 {"sigma_mm", Role::kSigma},
                                                                 {"views", Role::kViews},
                                                                 {"views_seen", Role::kViews},
                                                                 {"seen", Role::kSeen},
                                                                 {"cov_xx", Role::kCovXx},
                                                                 {"cov_xy", Role::kCovXy},
                                                                 {"cov_xz", Role::kCovXz},
                                                                 {"cov_yy", Role::kCovYy},
                                                                 {"cov_yz", Role::kCovYz},
                                                                 {"cov_zz", Role::kCovZz}};
  for (const auto& [known, role] : kNames) {
    if (known == name) return role;
  }
  return Role::kNone;
}

// What a colour of the type is multiplied with to become 0..255.
double colourScale(PlyType type) {
  if (type == PlyType::kF32 || type == PlyType::kF64) return 255.0;
  return type == PlyType::kU16 || type == PlyType::kI16 ? 1.0 / 257.0 : 1.0;
}

template <class Integer>
Integer rounded(double value) {
  constexpr double kMax = std::numeric_limits<Integer>::max();
  return static_cast<Integer>(std::isfinite(value) ? std::clamp(std::round(value), 0.0, kMax) : 0);
}

using RoleValues = std::array<double, kRoles>;

ModelVertex vertexOf(const RoleValues& values) {
  const auto at = [&](Role role) { return values[static_cast<std::size_t>(role)]; };
  ModelVertex entry;
  MeshVertex& vertex = entry.vertex;
  vertex.position = {at(Role::kX), at(Role::kY), at(Role::kZ)};
  vertex.normal = {at(Role::kNx), at(Role::kNy), at(Role::kNz)};
  vertex.rgb = {rounded<std::uint8_t>(at(Role::kRed)), rounded<std::uint8_t>(at(Role::kGreen)),
                rounded<std::uint8_t>(at(Role::kBlue))};
  vertex.sigma_mm = static_cast<float>(at(Role::kSigma));
  vertex.views = rounded<std::uint16_t>(at(Role::kViews));
  vertex.seen = rounded<std::uint8_t>(at(Role::kSeen));
  entry.covariance << at(Role::kCovXx), at(Role::kCovXy), at(Role::kCovXz),  //
      at(Role::kCovXy), at(Role::kCovYy), at(Role::kCovYz),                  //
      at(Role::kCovXz), at(Role::kCovYz), at(Role::kCovZz);
  return entry;
}

void readVertices(PlyNumbers& numbers, const PlyElement& element, ModelBuilder& builder) {
  std::vector<std::pair<Role, double>> columns;
  RoleValues values{};
  for (const Role colour : {Role::kRed, Role::kGreen, Role::kBlue}) {
    values[static_cast<std::size_t>(colour)] = kUncoloured[0];
  }
  values[static_cast<std::size_t>(Role::kSeen)] = 1.0;
  for (const PlyProperty& property : element.properties) {
    const Role role = property.list_length_type ? Role::kNone : roleOf(property.name);
    const bool colour = role == Role::kRed || role == Role::kGreen || role == Role::kBlue;
    columns.emplace_back(role, colour ? colourScale(property.type) : 1.0);
  }
  builder.vertices.reserve(element.count);
  for (std::uint64_t i = 0; i < element.count && !numbers.failed(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      std::uint64_t items = property.list_length_type ? numbers.takeLength(property) : 1;
      for (; items > 0; --items) {
        values[static_cast<std::size_t>(columns[k].first)] =
            numbers.take(property.type) * columns[k].second;
      }
    }
    builder.vertices.push_back(vertexOf(values));
  }
}

// Reads an element whose lists named vertex_indices are faces; any other element is passed over.
void readFaces(PlyNumbers& numbers, const PlyElement& element, ModelBuilder& builder) {
  if (element.properties.empty()) return;
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < element.count && !numbers.failed(); ++i) {
    for (const PlyProperty& property : element.properties) {
      const bool list = property.list_length_type.has_value();
      const bool face = list && element.name == "face" &&
                        (property.name == "vertex_indices" || property.name == "vertex_index");
      corners.clear();
      for (std::uint64_t items = list ? numbers.takeLength(property) : 1; items > 0; --items) {
        const double number = numbers.take(property.type);
        // Beyond every vertex, so that what is no index is found when the corners are checked.
        constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
        const bool index = number >= 0.0 && number < kNone;
        if (face) corners.push_back(index ? static_cast<std::uint32_t>(number) : kNone);
      }
      if (!numbers.failed()) builder.addFace(corners);
    }
  }
}

bool hasPosition(const PlyElement& element) {
  int found = 0;
  for (const PlyProperty& property : element.properties) {
    const bool position = property.name == "x" || property.name == "y" || property.name == "z";
    if (position && !property.list_length_type) ++found;
  }
  return found == 3;
}

}  // namespace

Result<Model> parsePly(std::string_view bytes, const std::string& file) {
  const auto header = parsePlyHeader(bytes, file);
  if (!header) return header.error();
  PlyNumbers numbers(bytes.substr(header->body_offset), header->format);
  ModelBuilder builder;
  for (const PlyElement& element : header->elements) {
    if (element.name != "vertex") {
      readFaces(numbers, element, builder);
    } else if (!hasPosition(element)) {
      return badPly(file, "has vertices without a position");
    } else {
      readVertices(numbers, element, builder);
    }
    if (numbers.failed()) {
      return badPly(file, "is cut off or damaged in its list of \"" + element.name + "\"");
    }
  }
  auto outcome = builder.finish();
  if (outcome.problem) return badPly(file, *outcome.problem);
  return std::move(outcome.model);
}

}  // namespace gyre
