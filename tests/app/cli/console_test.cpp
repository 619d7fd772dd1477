// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/console.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using ::testing::HasSubstr;

struct Streams {
  std::ostringstream out;
  std::ostringstream err;
};

TEST(Console, SaysErrorsWithAdviceOnStandardErrorAndGivesTheExitCode) {
  Streams streams;
  Console console(streams.out, streams.err, ProgressStyle::kLines);
  EXPECT_EQ(console.fail({Error::Code::kGone, "The port vanished.", "Plug it in."}), 1);
  EXPECT_EQ(console.wrongUse({Error::Code::kInvalidInput, "No views.", "Ask for some."}), 2);
  EXPECT_EQ(console.fail(cancelled()), 130);
  EXPECT_EQ(streams.err.str(),
            "The port vanished. Plug it in.\nNo views. Ask for some.\nStopped.\n");
  EXPECT_EQ(streams.out.str(), "");
}

TEST(Console, IsQuietAndVerboseAsAsked) {
  Streams streams;
  Console console(streams.out, streams.err, ProgressStyle::kLines);
  console.say("a result");
  console.note("a detail");
  console.setVerbosity(Verbosity::kQuiet);
  console.say("hidden");
  console.sayAlways("{}");
  console.setVerbosity(Verbosity::kVerbose);
  console.note("shown");
  EXPECT_EQ(streams.out.str(), "a result\n{}\n");
  EXPECT_EQ(streams.err.str(), "shown\n");
}

TEST(Console, RewritesItsProgressLineOnATerminal) {
  Streams streams;
  Console console(streams.out, streams.err, ProgressStyle::kTerminal);
  const Task task = console.task({});
  ASSERT_TRUE(task.sleepFor(0.12));
  task.report(0.25, "View 3 of 12");
  EXPECT_THAT(streams.err.str(), HasSubstr("\rView 3 of 12 (25 %)"));
  console.warn("Something.");
  EXPECT_THAT(streams.err.str(), HasSubstr("\r\x1b[KSomething.\n"));
}

TEST(Console, DoesNotFloodAFileWithProgress) {
  Streams streams;
  Console console(streams.out, streams.err, ProgressStyle::kLines);
  const Task task = console.task({});
  for (int i = 0; i < 100; ++i) task.report(0.01 * i, "Working");
  EXPECT_EQ(streams.err.str(), "");
}

TEST(TimeLeft, IsToldOnlyOnceItIsKnown) {
  EXPECT_EQ(timeLeftText(0.5, 1.0), "");
  EXPECT_EQ(timeLeftText(0.01, 10.0), "");
  EXPECT_EQ(timeLeftText(1.0, 10.0), "");
  EXPECT_EQ(timeLeftText(0.25, 10.0), "30 s left");
  EXPECT_EQ(timeLeftText(0.1, 60.0), "9 min left");
}

}  // namespace
}  // namespace gyre
