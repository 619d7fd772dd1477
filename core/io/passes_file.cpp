// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/passes_file.h"

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
constexpr std::size_t kMostPasses = 1000;
constexpr double kFarthest_mm = 1e6;
constexpr double kMostCount = 1e9;

// Takes fields out of the file and keeps the first thing that is wrong with them.
class FieldReader {
 public:
  explicit FieldReader(std::string file) : file_(std::move(file)) {}

  const std::optional<Error>& error() const { return error_; }

  void fail(const std::string& problem) {
    if (error_) return;
    error_ = Error{Error::Code::kInvalidInput, "The file \"" + file_ + "\" " + problem + ".",
                   "Merge the passes again."};
  }

  // The member, or null where there is none.
  static const json& member(const json& object, const char* key) {
    static const json kNull;
    if (object.is_object() && object.contains(key)) return object.at(key);
    return kNull;
  }

  double number(const json& value, const char* name, double least, double most) {
    const double found = value.is_number() ? value.get<double>() : HUGE_VAL;
    if (found >= least && found <= most) return found;
    fail(std::string("has an impossible value for \"") + name + "\"");
    return 0.0;
  }

  std::size_t count(const json& value, const char* name) {
    return static_cast<std::size_t>(number(value, name, 0.0, kMostCount));
  }

  std::string words(const json& value, const char* name) {
    if (value.is_string()) return value.get<std::string>();
    fail(std::string("has no text for \"") + name + "\"");
    return {};
  }

  Eigen::Vector3d vector(const json& value, const char* name, double most) {
    if (!value.is_array() || value.size() != 3) {
      fail(std::string("does not have three numbers in \"") + name + "\"");
      return Eigen::Vector3d::Zero();
    }
    return {number(value[0], name, -most, most), number(value[1], name, -most, most),
            number(value[2], name, -most, most)};
  }

  Rigid3 rigid(const json& value, const char* name) {
    Rigid3 transform;
    const json& rows = member(value, "rotation");
    if (!rows.is_array() || rows.size() != 3) {
      fail(std::string("has no rotation in \"") + name + "\"");
      return transform;
    }
    for (Eigen::Index row = 0; row < 3; ++row) {
      transform.rotation.row(row) = vector(rows[static_cast<std::size_t>(row)], name, 2.0);
    }
    transform.translation = vector(member(value, "translation_mm"), name, kFarthest_mm);
    if (!isRigid(transform)) fail(std::string("has no rotation in \"") + name + "\"");
    return transform;
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

ScanPass readOne(FieldReader& reader, const json& entry) {
  const auto at = [](const json& object, const char* key) -> const json& {
    return FieldReader::member(object, key);
  };
  ScanPass pass;
  pass.name = reader.words(at(entry, "name"), "name");
  const bool plain = pass.name.find_first_of("/\\") == std::string::npos && pass.name != ".." &&
                     pass.name != "." && !pass.name.empty();
  if (!plain) reader.fail("has an impossible name of a pass");
  pass.folder = std::filesystem::path(reader.words(at(entry, "folder"), "folder"));
  pass.views = reader.count(at(entry, "views"), "views");
  pass.merged_from_pass = reader.rigid(at(entry, "merged_from_pass"), "merged_from_pass");
  if (const json& fit = at(entry, "fit"); !fit.is_null()) {
    pass.fit = PassFit{reader.count(at(fit, "spots"), "spots"),
                       reader.number(at(fit, "spots_mm"), "spots_mm", 0.0, kFarthest_mm),
                       reader.number(at(fit, "overlap"), "overlap", 0.0, 1.0),
                       reader.number(at(fit, "residual_mm"), "residual_mm", 0.0, kFarthest_mm)};
  }
  return pass;
}

ordered_json listOf(const Eigen::Vector3d& vector) {
  return ordered_json{vector.x(), vector.y(), vector.z()};
}

ordered_json jsonOf(const ScanPass& pass) {
  ordered_json entry;
  entry["name"] = pass.name;
  entry["folder"] = pass.folder.string();
  entry["views"] = pass.views;
  ordered_json rows = ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row) {
    rows.push_back(listOf(pass.merged_from_pass.rotation.row(row)));
  }
  entry["merged_from_pass"]["rotation"] = std::move(rows);
  entry["merged_from_pass"]["translation_mm"] = listOf(pass.merged_from_pass.translation);
  entry["fit"] = ordered_json();
  if (pass.fit) {
    entry["fit"] = {{"spots", pass.fit->spots},
                    {"spots_mm", pass.fit->spots_mm},
                    {"overlap", pass.fit->overlap},
                    {"residual_mm", pass.fit->residual_mm}};
  }
  return entry;
}

}  // namespace

Result<std::vector<ScanPass>> parsePasses(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const json root = json::parse(text);
  FieldReader reader(file);
  if (FieldReader::member(root, "format") != "gyre-passes") {
    reader.fail("tells of no passes: its \"format\" is not \"gyre-passes\"");
  } else if (FieldReader::member(root, "version") != 1) {
    reader.fail("is of a version that this program does not know");
  }
  const json& list = FieldReader::member(root, "passes");
  if (!list.is_array() || list.empty() || list.size() > kMostPasses) {
    reader.fail("has no list of a sensible length for \"passes\"");
  }
  std::vector<ScanPass> passes;
  if (!reader.error()) {
    for (const json& entry : list) passes.push_back(readOne(reader, entry));
  }
  if (reader.error()) return *reader.error();
  return passes;
}

Result<std::vector<ScanPass>> readPasses(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  auto passes = parsePasses(*text, file.string());
  if (!passes) return passes;
  for (ScanPass& pass : *passes) {
    if (pass.folder.is_relative()) {
      pass.folder = (file.parent_path() / pass.folder).lexically_normal();
    }
  }
  return passes;
}

std::string passesText(const std::vector<ScanPass>& passes) {
  ordered_json root;
  root["format"] = "gyre-passes";
  root["version"] = 1;
  root["passes"] = ordered_json::array();
  for (const ScanPass& pass : passes) root["passes"].push_back(jsonOf(pass));
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<void> writePasses(const std::filesystem::path& file, const std::vector<ScanPass>& passes) {
  const std::string text = passesText(passes);
  if (const auto readable = parsePasses(text, file.string()); !readable) return readable.error();
  return writeFileAtomically(file, text);
}

}  // namespace gyre
