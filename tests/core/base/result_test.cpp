// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/result.h"

#include <memory>

#include <gtest/gtest.h>

namespace gyre {
namespace {

Result<std::unique_ptr<int>> half(int number) {
  if (number % 2 != 0) {
    return Error{Error::Code::kInvalidInput, "The number is odd.", "Give an even one."};
  }
  return std::make_unique<int>(number / 2);
}

TEST(Result, CarriesAMoveOnlyValue) {
  std::unique_ptr<int> two = half(4).value();
  EXPECT_EQ(*two, 2);
}

TEST(Result, CarriesBothSentencesOfAnError) {
  const auto result = half(3);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().sentence(), "The number is odd. Give an even one.");
}

TEST(Result, VoidSucceedsByDefault) {
  const Result<void> done;
  EXPECT_TRUE(done.ok());
  const Result<void> stopped = cancelled();
  EXPECT_EQ(stopped.error().code, Error::Code::kCancelled);
}

TEST(ResultDeathTest, EndsTheProgramWhenTheWrongSideIsAsked) {
  const auto result = half(3);
  EXPECT_DEATH((void)result.value(), "must hold");
}

}  // namespace
}  // namespace gyre
