// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/measurements_file.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::uintmax_t kMaxBytes = 16U << 20U;
constexpr double kFarthest_mm = 1e6;
constexpr std::size_t kLongestText = 10'000;
constexpr const char* kFileName = "measurements.json";

constexpr std::array<std::pair<SizeTrust, const char*>, 4> kTrustWords = {
    {{SizeTrust::kUnknown, "unknown"},
     {SizeTrust::kArbitrary, "arbitrary"},
     {SizeTrust::kNotVerified, "not verified"},
     {SizeTrust::kVerified, "verified"}}};

// Takes fields out of the file and keeps the first thing that is wrong with them.
class FieldReader {
 public:
  explicit FieldReader(std::string file) : file_(std::move(file)) {}

  const std::optional<Error>& error() const { return error_; }

  void fail(const std::string& problem) {
    if (error_) return;
    error_ = Error{Error::Code::kInvalidInput, "The file \"" + file_ + "\" " + problem + ".",
                   "Move it aside to start a new list; the model itself is untouched."};
  }

  static const json& member(const json& object, const char* key) {
    static const json kNull;
    if (object.is_object() && object.contains(key)) return object.at(key);
    return kNull;
  }

  double number(const json& value, const char* name, double least) {
    const double found = value.is_number() ? value.get<double>() : HUGE_VAL;
    if (found >= least && found <= kFarthest_mm) return found;
    fail(std::string("has an impossible value for \"") + name + "\"");
    return 0.0;
  }

  std::optional<double> numberOrNull(const json& value, const char* name) {
    if (value.is_null()) return std::nullopt;
    return number(value, name, 0.0);
  }

  Eigen::Vector3d place(const json& value, const char* name) {
    if (!value.is_array() || value.size() != 3) {
      fail(std::string("does not have three numbers for each \"") + name + "\"");
      return Eigen::Vector3d::Zero();
    }
    return {number(value[0], name, -kFarthest_mm), number(value[1], name, -kFarthest_mm),
            number(value[2], name, -kFarthest_mm)};
  }

  std::string words(const json& value, const char* name) {
    if (value.is_null()) return {};
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestText) {
      return value.get<std::string>();
    }
    fail(std::string("has no text of a sensible length for \"") + name + "\"");
    return {};
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

SizeTrust trustOf(const json& value) {
  for (const auto& [trust, word] : kTrustWords) {
    if (value == word) return trust;
  }
  return SizeTrust::kUnknown;
}

Measurement readOne(FieldReader& reader, const json& entry) {
  const auto at = [&](const char* key) -> const json& { return FieldReader::member(entry, key); };
  Measurement one;
  one.from_in_table = reader.place(at("from_mm"), "from_mm");
  one.to_in_table = reader.place(at("to_mm"), "to_mm");
  one.length_mm = reader.number(at("length_mm"), "length_mm", 0.0);
  const auto sigma_mm = reader.numberOrNull(at("sigma_mm"), "sigma_mm");
  one.points_sigma_mm = reader.numberOrNull(at("points_sigma_mm"), "points_sigma_mm");
  one.scale_sigma_mm = reader.numberOrNull(at("scale_sigma_mm"), "scale_sigma_mm");
  if (!one.points_sigma_mm && !one.scale_sigma_mm) one.points_sigma_mm = sigma_mm;
  one.size = trustOf(at("size"));
  one.caliper_mm = reader.numberOrNull(at("caliper_mm"), "caliper_mm");
  if (one.caliper_mm == 0.0) reader.fail("has an impossible value for \"caliper_mm\"");
  one.note = reader.words(at("note"), "note");
  one.date = reader.words(at("date"), "date");
  return one;
}

ordered_json jsonOf(const Measurement& one) {
  const auto place = [](const Eigen::Vector3d& at) { return ordered_json{at.x(), at.y(), at.z()}; };
  const auto known = [](const std::optional<double>& number) {
    return number ? ordered_json(*number) : ordered_json();
  };
  ordered_json entry;
  entry["from_mm"] = place(one.from_in_table);
  entry["to_mm"] = place(one.to_in_table);
  entry["length_mm"] = one.length_mm;
  entry["sigma_mm"] = known(one.sigmaMm());
  entry["points_sigma_mm"] = known(one.points_sigma_mm);
  entry["scale_sigma_mm"] = known(one.scale_sigma_mm);
  for (const auto& [trust, word] : kTrustWords) {
    if (trust == one.size) entry["size"] = word;
  }
  entry["caliper_mm"] = known(one.caliper_mm);
  entry["note"] = one.note;
  entry["date"] = one.date;
  return entry;
}

}  // namespace

Result<std::vector<Measurement>> parseMeasurements(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const json root = json::parse(text);
  FieldReader reader(file);
  if (FieldReader::member(root, "format") != "gyre-measurements") {
    reader.fail("holds no measurements of Gyre: its \"format\" is not \"gyre-measurements\"");
  } else if (FieldReader::member(root, "version") != 1) {
    reader.fail("is of a version that this program does not know");
  }
  const json& list = FieldReader::member(root, "measurements");
  if (!list.is_array() || list.size() > kMostMeasurements) {
    reader.fail("has no list of a sensible length for \"measurements\"");
  }
  std::vector<Measurement> measurements;
  if (!reader.error()) {
    for (const json& entry : list) {
      measurements.push_back(readOne(reader, entry));
      if (reader.error()) break;
    }
  }
  if (reader.error()) return *reader.error();
  return measurements;
}

Result<std::vector<Measurement>> readMeasurements(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseMeasurements(*text, file.string());
}

std::string measurementsText(const std::vector<Measurement>& measurements) {
  ordered_json root;
  root["format"] = "gyre-measurements";
  root["version"] = 1;
  root["measurements"] = ordered_json::array();
  for (const Measurement& one : measurements) root["measurements"].push_back(jsonOf(one));
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<void> writeMeasurements(const std::filesystem::path& file,
                               const std::vector<Measurement>& measurements) {
  const std::string text = measurementsText(measurements);
  if (const auto readable = parseMeasurements(text, file.string()); !readable) {
    return readable.error();
  }
  return writeFileAtomically(file, text);
}

Result<void> addMeasurement(const std::filesystem::path& folder, const Measurement& measurement) {
  const std::filesystem::path file = folder / kFileName;
  std::vector<Measurement> all;
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    auto read = readMeasurements(file);
    if (!read) return read.error();
    all = std::move(*read);
  }
  all.push_back(measurement);
  return writeMeasurements(file, all);
}

}  // namespace gyre
