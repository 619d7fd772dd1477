// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <limits>

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(CheckJson, TakesWhatIsJson) { EXPECT_TRUE(checkJson(R"({"a": [1, -2.5e3, "NaN"]})", "f")); }

TEST(CheckJson, NamesFileAndLine) {
  const auto checked = checkJson("{\n \"a\": 1,\n \"b\": x\n}", "rig.json");
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().what, HasSubstr("rig.json"));
  EXPECT_THAT(checked.error().what, HasSubstr("line 3"));
}

TEST(CheckJson, NamesTheWordThatIsNoNumber) {
  EXPECT_THAT(checkJson(R"({"a": NaN})", "f").error().what, HasSubstr("NaN"));
  EXPECT_THAT(checkJson(R"({"a": -Infinity})", "f").error().what, HasSubstr("Infinity"));
  EXPECT_THAT(checkJson(R"({"NaN": ?})", "f").error().what, HasSubstr("line 1"));
}

TEST(CheckJson, RefusesNumbersBeyondDouble) {
  EXPECT_THAT(checkJson(R"({"a": 1e999})", "f").error().what, HasSubstr("too large"));
}

TEST(CheckJson, SurvivesDeepNesting) { EXPECT_FALSE(checkJson(std::string(200000, '['), "f")); }

TEST(JsonNumber, KeepsEveryBit) {
  for (const double value : {0.0, -0.0, 0.1, -1.0 / 3.0, 1e-310, 1500.0, 1e300}) {
    const std::string text = jsonNumber(value);
    double back = 1.0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(back, value);
    EXPECT_EQ(std::signbit(back), std::signbit(value));
    EXPECT_TRUE(checkJson(text, "f"));
  }
  EXPECT_FALSE(checkJson(jsonNumber(std::numeric_limits<double>::quiet_NaN()), "f"));
}

TEST(JsonString, EscapesAndReplacesWhatIsNotUtf8) {
  EXPECT_EQ(jsonString("a\"b\n"), "\"a\\\"b\\n\"");
  EXPECT_TRUE(checkJson(jsonString("\xFF\xFE"), "f"));
}

}  // namespace
}  // namespace gyre
