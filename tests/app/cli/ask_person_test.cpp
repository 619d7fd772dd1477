// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/ask_person.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/watched_target.h"

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

// A table that does as it is told, behind a lock.
class LockedTableTest : public AskPersonTest {
 protected:
  LockedTableTest() { table_.lock = "The board is locked: homing is on."; }

  test::OddTable table_{[](double told_rad) { return told_rad; }};
};

TEST_F(LockedTableTest, IsUnlockedByTheWordAndNobodyIsAsked) {
  EXPECT_TRUE(allowUnlock(table_, UnlockWord::kGiven, console_, Task(), keys_[0]));
  EXPECT_TRUE(table_.may_unlock);
  EXPECT_EQ(err_.str(), "");
}

TEST_F(LockedTableTest, StaysLockedWhereNobodySitsAtATerminal) {
  press("y\n");
  const auto allowed = allowUnlock(table_, UnlockWord::kAsk, console_, Task(), keys_[0]);
  ASSERT_FALSE(allowed);
  EXPECT_EQ(allowed.error().code, Error::Code::kNoPermission);
  EXPECT_EQ(allowed.error().what, table_.lock);
  EXPECT_FALSE(table_.may_unlock);
}

TEST_F(LockedTableTest, IsUnlockedByAYesAtTheTerminalOnly) {
  const int person = posix_openpt(O_RDWR | O_NOCTTY);
  if (person < 0 || grantpt(person) != 0 || unlockpt(person) != 0) {
    GTEST_SKIP() << "This machine has no pseudo terminals.";
  }
  const int terminal = open(ptsname(person), O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  for (const char* answer : {"\n", "n\n", "maybe\n"}) {
    ASSERT_GT(write(person, answer, strlen(answer)), 0);
    const auto allowed = allowUnlock(table_, UnlockWord::kAsk, console_, Task(), terminal);
    ASSERT_FALSE(allowed);
    EXPECT_EQ(allowed.error().code, Error::Code::kNoPermission);
    EXPECT_FALSE(table_.may_unlock);
  }
  EXPECT_THAT(err_.str(), HasSubstr("homing is on"));
  EXPECT_THAT(err_.str(), HasSubstr("May it be unlocked"));
  ASSERT_GT(write(person, "y\n", 2), 0);
  EXPECT_TRUE(allowUnlock(table_, UnlockWord::kAsk, console_, Task(), terminal));
  EXPECT_TRUE(table_.may_unlock);
  close(terminal);
  close(person);
}

TEST_F(LockedTableTest, TableWithoutALockIsLeftAlone) {
  table_.lock.clear();
  EXPECT_TRUE(allowUnlock(table_, UnlockWord::kAsk, console_, Task(), keys_[0]));
  EXPECT_TRUE(allowUnlock(table_, UnlockWord::kGiven, console_, Task(), keys_[0]));
  EXPECT_FALSE(table_.may_unlock);
}

}  // namespace
}  // namespace gyre
