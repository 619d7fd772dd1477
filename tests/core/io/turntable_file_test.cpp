// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/turntable_file.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

constexpr const char* kGood = R"({
  "format": "gyre-turntable", "version": 1, "name": "Mine", "baud": 9600, "line_end": "\r\n",
  "greeting": "hello", "ask": {"send": "WHO", "answer": "Mine"},
  "unit": "steps", "units_per_turn": 6400, "direction": -1,
  "motor_on": {"send": "ON", "answer": "OK"}, "motor_off": {"send": "OFF", "answer": "OK"},
  "move": {"send": "TURN {by}", "done": "DONE", "refused": "ERR", "busy": "WAIT"},
  "stop": {"send": "STOP", "answer": "STOPPED"} })";

// The good one with one part put in another's place.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(TurntableFile, ReadsAllThatItSays) {
  const auto table = parseTurntableDescription(kGood, "mine.json");
  ASSERT_TRUE(table) << table.error().sentence();
  EXPECT_EQ(table->name, "Mine");
  EXPECT_EQ(table->baud, 9600);
  EXPECT_EQ(table->line_end, "\r\n");
  EXPECT_EQ(table->greeting, "hello");
  EXPECT_EQ(table->ask.send, "WHO");
  EXPECT_EQ(table->unit, TurntableDescription::Unit::kSteps);
  EXPECT_EQ(table->units_per_turn, 6400.0);
  EXPECT_EQ(table->direction, -1);
  EXPECT_EQ(table->motor_off.send, "OFF");
  EXPECT_EQ(table->move, "TURN {by}");
  EXPECT_EQ(table->done, "DONE");
  EXPECT_EQ(table->busy, "WAIT");
  EXPECT_EQ(table->stop.answer, "STOPPED");
}

TEST(TurntableFile, ExamplesCanBeUsed) {
  for (const char* name : {"/workshop.json", "/degrees.json"}) {
    const auto table = readTurntableDescription(std::string(GYRE_TURNTABLES) + name);
    EXPECT_TRUE(table) << table.error().sentence();
  }
}

struct Wrong {
  std::string from;
  std::string to;
  std::string told;
};

TEST(TurntableFile, WhatCannotBeUsedIsToldInASentence) {
  const std::vector<Wrong> all = {
      {"gyre-turntable", "gyre-target", "no turntable of Gyre"},
      {"\"version\": 1", "\"version\": 2", "version"},
      {"\"Mine\", \"baud\"", "\"\", \"baud\"", "no \"name\""},
      {"9600", "9600.5", "whole number"},
      {"9600", "-1", "impossible value for \"baud\""},
      {"9600", "\"fast\"", "impossible value for \"baud\""},
      {"\"steps\"", "\"radians\"", "\"steps\" or \"degrees\""},
      {"\"units_per_turn\": 6400,", "", "how many steps one turn has"},
      {"6400", "0", "impossible value"},
      {"-1,", "0,", "1 or -1"},
      {"-1,", "-1, \"decimals\": 2,", "decimals of steps"},
      {"TURN {by}", "TURN", "either {by} or {to}"},
      {"TURN {by}", "TURN {by} {to}", "either {by} or {to}"},
      {"\"done\": \"DONE\",", "", "lacks \"done\""},
      {"\"move\"", "\"moves\"", "\"moves\""},
      {"\"send\": \"STOP\", ", "", "both \"send\" and \"answer\""},
      {"\"STOP\"", "7", "no text"},
      {"\"ON\"", "\"G28\"", "homes or heats"},
      {"TURN {by}", "M104 S200 {by}", "homes or heats"},
      {"\"WHO\"", "\"$H\"", "homes or heats"},
  };
  for (const Wrong& wrong : all) {
    const auto table = parseTurntableDescription(changed(wrong.from, wrong.to), "mine.json");
    ASSERT_FALSE(table) << wrong.to;
    EXPECT_EQ(table.error().code, Error::Code::kInvalidInput);
    EXPECT_THAT(table.error().what, HasSubstr(wrong.told));
    EXPECT_THAT(table.error().what, HasSubstr("mine.json"));
  }
}

TEST(TurntableFile, TableThatCannotBeToldFromOthersIsRefused) {
  std::string text = changed("\"greeting\": \"hello\", ", "");
  text.replace(text.find("\"ask\""), text.find("\"unit\"") - text.find("\"ask\""), "");
  const auto table = parseTurntableDescription(text, "mine.json");
  ASSERT_FALSE(table);
  EXPECT_THAT(table.error().what, HasSubstr("\"greeting\" or \"ask\""));
}

TEST(TurntableFile, BrokenAndMissingFilesAreTold) {
  EXPECT_FALSE(parseTurntableDescription("{", "mine.json"));
  EXPECT_FALSE(parseTurntableDescription("", "mine.json"));
  EXPECT_FALSE(parseTurntableDescription("[]", "mine.json"));
  const TempDir folder;
  EXPECT_FALSE(readTurntableDescription(folder / "none.json"));
  const auto read = readTurntableDescription(putFile(folder / "mine.json", kGood));
  EXPECT_TRUE(read) << read.error().sentence();
}

}  // namespace
}  // namespace gyre
