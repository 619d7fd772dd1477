// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/measurements_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

Measurement sample() {
  Measurement one;
  one.from_in_table = {1.0 / 3.0, -2.5, 40.0};
  one.to_in_table = {0, 30, 0.1};
  one.length_mm = 51.234567890123;
  one.points_sigma_mm = 0.03;
  one.scale_sigma_mm = 0.04;
  one.size = SizeTrust::kNotVerified;
  one.caliper_mm = 51.3;
  one.note = "rim \"to\" foot, ü";
  one.date = "2026-01-02T03:04:05Z";
  return one;
}

std::string listOf(const std::string& entry) {
  return "{\"format\":\"gyre-measurements\",\"version\":1,\"measurements\":[" + entry + "]}";
}

TEST(MeasurementsFile, GivesBackWhatWasWritten) {
  const TempDir dir;
  Measurement bare;
  bare.to_in_table = {0, 0, 1};
  bare.length_mm = 1.0;
  ASSERT_TRUE(addMeasurement(dir.path(), sample()));
  ASSERT_TRUE(addMeasurement(dir.path(), bare));
  const auto read = readMeasurements(dir / "measurements.json");
  ASSERT_TRUE(read) << read.error().sentence();
  ASSERT_EQ(read->size(), 2U);
  const Measurement& one = read->front();
  EXPECT_EQ(one.from_in_table, sample().from_in_table);
  EXPECT_EQ(one.to_in_table, sample().to_in_table);
  EXPECT_EQ(one.length_mm, sample().length_mm);
  EXPECT_EQ(one.points_sigma_mm, 0.03);
  EXPECT_EQ(one.scale_sigma_mm, 0.04);
  EXPECT_EQ(one.size, SizeTrust::kNotVerified);
  EXPECT_EQ(one.caliper_mm, 51.3);
  EXPECT_EQ(one.note, sample().note);
  EXPECT_EQ(one.date, sample().date);
  EXPECT_FALSE(read->back().sigmaMm());
  EXPECT_FALSE(read->back().caliper_mm);
  EXPECT_THAT(fileText(dir / "measurements.json"), HasSubstr("\"sigma_mm\": 0.05,"));
}

TEST(MeasurementsFile, TakesTheSigmaOfOthersAsThePoints) {
  const auto read = parseMeasurements(
      listOf(R"({"from_mm":[0,0,0],"to_mm":[3,4,0],"length_mm":5,"sigma_mm":0.2,"caliper_mm":null,
                 "note":"a"})"),
      "f");
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_EQ(read->front().sigmaMm(), 0.2);
  EXPECT_EQ(read->front().size, SizeTrust::kUnknown);
}

TEST(MeasurementsFile, SaysWhatIsWrong) {
  const auto problem = [](const std::string& text) {
    const auto read = parseMeasurements(text, "f");
    return read ? std::string("accepted") : read.error().sentence();
  };
  EXPECT_THAT(problem("{"), HasSubstr("line"));
  EXPECT_THAT(problem("[]"), HasSubstr("gyre-measurements"));
  EXPECT_THAT(problem("{\"format\":\"gyre-measurements\",\"version\":2}"), HasSubstr("version"));
  EXPECT_THAT(problem("{\"format\":\"gyre-measurements\",\"version\":1}"), HasSubstr("no list"));
  EXPECT_THAT(problem(listOf("7")), HasSubstr("from_mm"));
  const std::string places = "{\"from_mm\":[0,0,0],\"to_mm\":[1,0,0],\"length_mm\":";
  EXPECT_THAT(problem(listOf(places + "-1}")), HasSubstr("length_mm"));
  EXPECT_THAT(problem(listOf(places + "1e300}")), HasSubstr("length_mm"));
  EXPECT_THAT(problem(listOf(places + "1,\"caliper_mm\":0}")), HasSubstr("caliper_mm"));
  EXPECT_THAT(problem(listOf(places + "1,\"sigma_mm\":\"a\"}")), HasSubstr("sigma_mm"));
  EXPECT_THAT(problem(listOf(places + "1,\"note\":[]}")), HasSubstr("note"));
  EXPECT_EQ(problem(listOf(places + "1}")), "accepted");
}

TEST(MeasurementsFile, RefusesAnEndlessList) {
  std::string entries = "0";
  for (std::size_t i = 0; i < kMostMeasurements; ++i) entries += ",0";
  EXPECT_THAT(parseMeasurements(listOf(entries), "f").error().what, HasSubstr("sensible length"));
}

TEST(AddMeasurement, LeavesAFileAloneThatItCannotRead) {
  const TempDir dir;
  putFile(dir / "measurements.json", "notes of mine");
  const auto added = addMeasurement(dir.path(), sample());
  ASSERT_FALSE(added);
  EXPECT_EQ(fileText(dir / "measurements.json"), "notes of mine");
  Measurement endless = sample();
  endless.length_mm = HUGE_VAL;
  EXPECT_FALSE(addMeasurement(dir / "nowhere", sample()));
  EXPECT_FALSE(writeMeasurements(dir / "other.json", {endless}));
}

}  // namespace
}  // namespace gyre
