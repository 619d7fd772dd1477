// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/turntable_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

using nlohmann::json;
using Unit = TurntableDescription::Unit;

constexpr std::uintmax_t kMaxBytes = 64U << 10U;
constexpr std::size_t kLongestText = 200;
constexpr std::size_t kLongestKeyTold = 40;
constexpr double kMostUnits = 1e8;
constexpr int kMostDecimals = 4;
// No table needs these, and on a mill or a printer they move or heat what should rest.
constexpr std::array kForbidden = {"$H", "G28", "M104", "M109", "M140", "M190"};

// Takes fields out of the file and keeps the first thing that is wrong with them.
class FieldReader {
 public:
  explicit FieldReader(std::string file) : file_(std::move(file)) {}

  const std::optional<Error>& error() const { return error_; }

  void fail(const std::string& problem) {
    if (error_) return;
    error_ = Error{Error::Code::kInvalidInput,
                   "The turntable description \"" + file_ + "\" " + problem + ".",
                   "Compare with the examples among the program's resources, and with the guide "
                   "on turntables."};
  }

  void knowOnly(const json& object, std::initializer_list<const char*> keys) {
    for (const auto& [key, value] : object.items()) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        const bool short_enough = key.size() <= kLongestKeyTold;
        fail((short_enough ? "has the key \"" + key + "\"" : "has a very long key") +
             ", which means nothing here");
      }
    }
  }

  std::string text(const json& object, const char* key, const char* otherwise = "") {
    if (!object.contains(key)) return otherwise;
    const json& value = object.at(key);
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestText) {
      return value.get<std::string>();
    }
    fail(std::string("has no text of a sensible length for \"") + key + "\"");
    return {};
  }

  // What is sent, checked for words that no table needs.
  std::string sending(const json& object, const char* key) {
    std::string line = text(object, key);
    for (const char* word : kForbidden) {
      if (line.find(word) != std::string::npos) {
        fail(std::string("would send \"") + word + "\", which homes or heats");
      }
    }
    return line;
  }

  double number(const json& object, const char* key, double least, double most) {
    const json& value = object.at(key);
    const double found = value.is_number() ? value.get<double>() : HUGE_VAL;
    if (found >= least && found <= most) return found;
    fail(std::string("has an impossible value for \"") + key + "\"");
    return least;
  }

  int whole(const json& object, const char* key, int least, int most) {
    const double found = number(object, key, least, most);
    if (found != std::floor(found)) {
      fail(std::string("has no whole number for \"") + key + "\"");
    }
    return static_cast<int>(found);
  }

  // "ask": {"send": "WHO", "answer": "Workshop table"}, or nothing.
  TurntableExchange exchange(const json& root, const char* key) {
    if (!root.contains(key)) return {};
    const json& object = root.at(key);
    if (!object.is_object()) {
      fail(std::string("has no \"send\" and \"answer\" in \"") + key + "\"");
      return {};
    }
    knowOnly(object, {"send", "answer"});
    TurntableExchange words{sending(object, "send"), text(object, "answer")};
    if (words.send.empty() || words.answer.empty()) {
      fail(std::string("needs both \"send\" and \"answer\" in \"") + key + "\"");
    }
    return words;
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

void readUnit(FieldReader& reader, const json& root, TurntableDescription& table) {
  const std::string unit = reader.text(root, "unit");
  if (unit != "steps" && unit != "degrees") {
    reader.fail("must say \"steps\" or \"degrees\" for \"unit\"");
  }
  table.unit = unit == "degrees" ? Unit::kDegrees : Unit::kSteps;
  if (root.contains("units_per_turn")) {
    table.units_per_turn = reader.number(root, "units_per_turn", 1.0, kMostUnits);
  } else if (table.unit == Unit::kDegrees) {
    table.units_per_turn = 360.0;
  } else {
    reader.fail("must say how many steps one turn has, in \"units_per_turn\"");
  }
  if (root.contains("decimals")) {
    table.decimals = reader.whole(root, "decimals", 0, kMostDecimals);
    if (table.unit == Unit::kSteps && table.decimals != 0) {
      reader.fail("has decimals of steps, which are whole");
    }
  }
  if (root.contains("direction")) {
    table.direction = reader.whole(root, "direction", -1, 1);
    if (table.direction == 0) reader.fail("must say 1 or -1 for \"direction\"");
  }
}

void readMove(FieldReader& reader, const json& root, TurntableDescription& table) {
  if (!root.contains("move") || !root.at("move").is_object()) {
    reader.fail("does not say how to turn the table: it lacks \"move\"");
    return;
  }
  const json& move = root.at("move");
  reader.knowOnly(move, {"send", "done", "refused", "busy"});
  table.move = reader.sending(move, "send");
  table.done = reader.text(move, "done");
  table.refused = reader.text(move, "refused");
  table.busy = reader.text(move, "busy");
  const bool by = table.move.find("{by}") != std::string::npos;
  const bool to = table.move.find("{to}") != std::string::npos;
  if (by == to) reader.fail("must have either {by} or {to} in what \"move\" sends");
  if (table.done.empty()) {
    reader.fail("does not say by what line the table tells that it stands: it lacks \"done\"");
  }
}

void readHead(FieldReader& reader, const json& root, TurntableDescription& table) {
  reader.knowOnly(root, {"format", "version", "name", "baud", "line_end", "answer_ends", "greeting",
                         "ask", "unit", "units_per_turn", "decimals", "direction", "motor_on",
                         "motor_off", "move", "stop", "comment"});
  if (root.value("version", json()) != 1) {
    reader.fail("is of a version that this program does not know");
  }
  table.name = reader.text(root, "name");
  if (table.name.empty()) reader.fail("has no \"name\"");
  if (root.contains("baud")) table.baud = reader.whole(root, "baud", 300, 4000000);
  table.line_end = reader.text(root, "line_end", "\n");
  table.answer_ends = reader.text(root, "answer_ends", "\r\n");
  if (table.answer_ends.empty()) reader.fail("has no sign in \"answer_ends\"");
  table.greeting = reader.text(root, "greeting");
  table.ask = reader.exchange(root, "ask");
  if (table.greeting.empty() && table.ask.send.empty()) {
    reader.fail("says nothing by which the table is known: it needs \"greeting\" or \"ask\"");
  }
}

}  // namespace

Result<TurntableDescription> parseTurntableDescription(std::string_view text,
                                                       const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const json root = json::parse(text, nullptr, false);
  FieldReader reader(file);
  TurntableDescription table;
  if (!root.is_object() || root.value("format", json()) != "gyre-turntable") {
    reader.fail("is no turntable of Gyre: its \"format\" is not \"gyre-turntable\"");
    return *reader.error();
  }
  readHead(reader, root, table);
  readUnit(reader, root, table);
  readMove(reader, root, table);
  table.motor_on = reader.exchange(root, "motor_on");
  table.motor_off = reader.exchange(root, "motor_off");
  table.stop = reader.exchange(root, "stop");
  if (reader.error()) return *reader.error();
  return table;
}

Result<TurntableDescription> readTurntableDescription(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseTurntableDescription(*text, file.filename().string());
}

}  // namespace gyre
