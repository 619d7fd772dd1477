// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/option_list.h"

#include <limits>

#include <gtest/gtest.h>

namespace gyre {
namespace {

struct Oven {
  double temperature_deg = 180.0;
  int minutes = 20;
  bool fan = false;
  std::string dish = "bread";

  template <class V>
  void describe(V& visit) {
    visit({"temperature", "deg", 50, 250, "How hot."}, temperature_deg);
    visit({"minutes", "min", 1, 90, "How long."}, minutes);
    visit({"fan", "", 0, 0, "Moves the air."}, fan);
    visit({"dish", "", 0, 0, "What is baked."}, dish);
  }
};

TEST(OptionList, SetsEveryKindOfFieldFromText) {
  Oven oven;
  const OptionList list = OptionList::of(oven);
  EXPECT_TRUE(list.find("temperature")->setFromText("200.5"));
  EXPECT_TRUE(list.find("minutes")->setFromText("5"));
  EXPECT_TRUE(list.find("fan")->setFromText("true"));
  EXPECT_TRUE(list.find("dish")->setFromText("cake"));
  EXPECT_EQ(oven.temperature_deg, 200.5);
  EXPECT_EQ(oven.minutes, 5);
  EXPECT_TRUE(oven.fan);
  EXPECT_EQ(oven.dish, "cake");
  EXPECT_EQ(list.find("temperature")->valueText(), "200.5");
}

TEST(OptionList, RefusesTextThatDoesNotFitAndKeepsTheField) {
  Oven oven;
  const OptionList list = OptionList::of(oven);
  for (const char* text : {"", "hot", "300", "nan", "20x"}) {
    const Result<void> set = list.find("temperature")->setFromText(text);
    ASSERT_FALSE(set) << text;
    EXPECT_NE(set.error().advice.find("50 to 250 deg"), std::string::npos);
  }
  EXPECT_FALSE(list.find("fan")->setFromText("maybe"));
  EXPECT_EQ(oven.temperature_deg, 180.0);
}

TEST(OptionList, ValidatesRangesAndFiniteness) {
  Oven oven;
  EXPECT_TRUE(validateRanges(oven));
  oven.minutes = 0;
  EXPECT_FALSE(validateRanges(oven));
  oven.minutes = 1;
  oven.temperature_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(validateRanges(oven));
}

TEST(OptionList, FindsNothingUnderAnUnknownName) {
  Oven oven;
  EXPECT_EQ(OptionList::of(oven).find("humidity"), nullptr);
}

}  // namespace
}  // namespace gyre
