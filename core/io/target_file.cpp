// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/target_file.h"

#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"
#include "core/io/target_check.h"

namespace gyre {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMaxBytes = 16U << 20U;
constexpr std::size_t kMostEntries = 5000;  // of any list
constexpr std::size_t kLongestName = 200;
constexpr double kFarthest_mm = 1e4;
constexpr int kLargestId = 1000000000;

// Takes fields out of the file and keeps the first thing that is wrong with them.
class FieldReader {
 public:
  explicit FieldReader(std::string file) : file_(std::move(file)) {}

  const std::optional<Error>& error() const { return error_; }

  void fail(const std::string& problem) {
    if (error_) return;
    error_ = Error{Error::Code::kInvalidInput, "The target \"" + file_ + "\" " + problem + ".",
                   "Compare with the file that `gyre print-target` writes beside each sheet."};
  }

  // The member, or null: a failure unless it may be absent.
  const json& member(const json& object, const char* key) {
    const json& found = optionalMember(object, key);
    if (found.is_null()) fail(std::string("lacks \"") + key + "\"");
    return found;
  }

  static const json& optionalMember(const json& object, const char* key) {
    static const json kNull;
    if (object.is_object() && object.contains(key)) return object.at(key);
    return kNull;
  }

  // The list, or an empty one after a failure.
  const json& list(const json& value, const char* name) {
    static const json kNone = json::array();
    if (value.is_array() && value.size() <= kMostEntries) return value;
    fail(std::string("has no list of a sensible length for \"") + name + "\"");
    return kNone;
  }

  double number(const json& value, const char* name) {
    const double found = value.is_number() ? value.get<double>() : HUGE_VAL;
    if (std::isfinite(found) && std::abs(found) <= kFarthest_mm) return found;
    fail(std::string("has an impossible value for \"") + name + "\"");
    return 0.0;
  }

  int id(const json& value) {
    if (value.is_number_integer() && value >= 0 && value <= kLargestId) return value.get<int>();
    fail("has an \"id\" that is not a whole number from 0");
    return 0;
  }

  std::string words(const json& value, const char* name) {
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestName) {
      return value.get<std::string>();
    }
    fail(std::string("has no text of a sensible length for \"") + name + "\"");
    return {};
  }

  Eigen::Vector3d place(const json& value, const char* name) {
    if (!value.is_array() || value.size() != 3) {
      fail(std::string("does not have three numbers for each of \"") + name + "\"");
      return Eigen::Vector3d::Zero();
    }
    return {number(value[0], name), number(value[1], name), number(value[2], name)};
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

void readHead(FieldReader& reader, const json& root, Target& target) {
  if (!root.is_object() || root.value("format", json()) != "gyre-target") {
    reader.fail("is no target of Gyre: its \"format\" is not \"gyre-target\"");
    return;
  }
  if (root.value("version", json()) != 1) {
    reader.fail("is of a version that this program does not know");
    return;
  }
  target.name = reader.words(reader.member(root, "name"), "name");
  const json& dictionary = FieldReader::optionalMember(root, "dictionary");
  if (!dictionary.is_null()) target.dictionary = reader.words(dictionary, "dictionary");
}

void readPoints(FieldReader& reader, const json& root, Target& target) {
  for (const json& entry : reader.list(reader.member(root, "corners"), "corners")) {
    TargetCorner& corner = target.corners.emplace_back();
    corner.id = reader.id(reader.member(entry, "id"));
    corner.position_in_target = {reader.number(reader.member(entry, "x"), "x"),
                                 reader.number(reader.member(entry, "y"), "y"),
                                 reader.number(reader.member(entry, "z"), "z")};
    if (reader.error()) return;
  }
  for (const json& entry : reader.list(reader.member(root, "markers"), "markers")) {
    TargetMarker& marker = target.markers.emplace_back();
    marker.id = reader.id(reader.member(entry, "id"));
    const json& corners = reader.member(entry, "corners");
    if (!corners.is_array() || corners.size() != 4) {
      reader.fail("does not have four corners for each marker");
      return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      marker.corners_in_target[i] = reader.place(corners[i], "corners");
    }
    if (reader.error()) return;
  }
}

void readFaces(FieldReader& reader, const json& root, Target& target) {
  for (const json& entry : reader.list(reader.member(root, "faces"), "faces")) {
    std::vector<int>& face = target.faces.emplace_back();
    for (const json& id : reader.list(entry, "faces")) face.push_back(reader.id(id));
    if (reader.error()) return;
  }
  const json& axes = FieldReader::optionalMember(root, "page_axes");
  if (!axes.is_null()) {
    for (const json& entry : reader.list(axes, "page_axes")) {
      target.page_axes.push_back({reader.place(reader.member(entry, "right"), "right"),
                                  reader.place(reader.member(entry, "down"), "down")});
    }
  }
  const json& dots = FieldReader::optionalMember(root, "dots");
  if (dots.is_null()) return;
  for (const json& entry : reader.list(dots, "dots")) {
    TargetDot& dot = target.dots.emplace_back();
    dot.centre_in_target = reader.place(reader.member(entry, "centre"), "centre");
    dot.diameter_mm = reader.number(reader.member(entry, "diameter"), "diameter");
    if (dot.diameter_mm <= 0.0) reader.fail("has a dot without a size");
  }
}

std::string placeText(const Eigen::Vector3d& place) {
  return "[" + jsonNumber(place.x()) + ", " + jsonNumber(place.y()) + ", " + jsonNumber(place.z()) +
         "]";
}

// "key": [ entries, one a line ]
template <class Entries, class Text>
std::string listText(const char* key, const Entries& entries, const Text& text) {
  std::string all = std::string("  \"") + key + "\": [";
  const char* before = "\n    ";
  for (const auto& entry : entries) {
    all += before + text(entry);
    before = ",\n    ";
  }
  return all + (entries.empty() ? "]" : "\n  ]");
}

}  // namespace

Result<Target> parseTarget(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const json root = json::parse(text);
  FieldReader reader(file);
  Target target;
  readHead(reader, root, target);
  if (!reader.error()) readPoints(reader, root, target);
  if (!reader.error()) readFaces(reader, root, target);
  if (!reader.error()) {
    if (const auto fault = faultOf(target)) reader.fail(*fault);
  }
  if (reader.error()) return *reader.error();
  return target;
}

Result<Target> readTarget(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseTarget(*text, file.string());
}

std::string targetText(const Target& target) {
  std::string text = "{\n  \"format\": \"gyre-target\",\n  \"version\": 1,\n  \"name\": " +
                     jsonString(target.name) +
                     ",\n  \"dictionary\": " + jsonString(target.dictionary) + ",\n";
  text += listText("corners", target.corners, [](const TargetCorner& corner) {
    const Eigen::Vector3d& at = corner.position_in_target;
    return "{\"id\": " + std::to_string(corner.id) + ", \"x\": " + jsonNumber(at.x()) +
           ", \"y\": " + jsonNumber(at.y()) + ", \"z\": " + jsonNumber(at.z()) + "}";
  });
  text += ",\n" + listText("markers", target.markers, [](const TargetMarker& marker) {
            const auto& at = marker.corners_in_target;
            return "{\"id\": " + std::to_string(marker.id) + ", \"corners\": [" + placeText(at[0]) +
                   ", " + placeText(at[1]) + ", " + placeText(at[2]) + ", " + placeText(at[3]) +
                   "]}";
          });
  text += ",\n" + listText("faces", target.faces, [](const std::vector<int>& face) {
            std::string ids;
            for (const int id : face) ids += (ids.empty() ? "" : ", ") + std::to_string(id);
            return "[" + ids + "]";
          });
  text += ",\n" + listText("page_axes", target.page_axes, [](const PageAxes& axes) {
            return "{\"right\": " + placeText(axes.right_in_target) +
                   ", \"down\": " + placeText(axes.down_in_target) + "}";
          });
  text += ",\n" + listText("dots", target.dots, [](const TargetDot& dot) {
            return "{\"centre\": " + placeText(dot.centre_in_target) +
                   ", \"diameter\": " + jsonNumber(dot.diameter_mm) + "}";
          });
  return text + "\n}\n";
}

Result<void> writeTarget(const std::filesystem::path& file, const Target& target) {
  const std::string text = targetText(target);
  if (const auto readable = parseTarget(text, file.string()); !readable) return readable.error();
  return writeFileAtomically(file, text);
}

}  // namespace gyre
