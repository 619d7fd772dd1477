// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/ask_person.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::HasSubstr;

class AskPersonTest : public testing::Test {
 protected:
  AskPersonTest() { EXPECT_EQ(pipe(keys_.data()), 0); }
  ~AskPersonTest() override {
    close(keys_[0]);
    if (keys_[1] >= 0) close(keys_[1]);
  }
  void press(const std::string& keys) {
    EXPECT_EQ(write(keys_[1], keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }

  std::array<int, 2> keys_{};
  std::ostringstream out_;
  std::ostringstream err_;
  Console console_{out_, err_, ProgressStyle::kLines};
};

TEST_F(AskPersonTest, SaysWhatToDoAndWaitsForEnter) {
  press("yes\n");
  EXPECT_TRUE(askAtTerminal(console_, keys_[0])({3, 45.0, 15.0}, Task()));
  EXPECT_THAT(err_.str(), HasSubstr("counter-clockwise"));
  EXPECT_THAT(err_.str(), HasSubstr("3 marks to 45\u00b0"));
  press("\n");
  EXPECT_TRUE(askAtTerminal(console_, keys_[0])({-1, 30.0, 15.0}, Task()));
  EXPECT_THAT(err_.str(), HasSubstr("clockwise, seen from above, by 1 mark to 30\u00b0"));
}

TEST_F(AskPersonTest, OneEnterIsOneTurn) {
  press("\n");
  const AskPerson ask = askAtTerminal(console_, keys_[0]);
  EXPECT_TRUE(ask({1, 15.0, 15.0}, Task()));
  std::stop_source source;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    source.request_stop();
  });
  const Result<void> second = ask({1, 30.0, 15.0}, Task(source.get_token()));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Error::Code::kCancelled);
}

TEST_F(AskPersonTest, EndOfTheInputIsNobody) {
  close(keys_[1]);
  keys_[1] = -1;
  const Result<void> asked = askAtTerminal(console_, keys_[0])({1, 15.0, 15.0}, Task());
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().code, Error::Code::kGone);
  EXPECT_THAT(asked.error().advice, HasSubstr("gyre resume"));
}

}  // namespace
}  // namespace gyre
