// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command_line.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using ::testing::HasSubstr;

struct Answer {
  int code = 0;
  std::string out;
  std::string err;
};

Answer gyre(const std::vector<std::string>& words) {
  std::ostringstream out;
  std::ostringstream err;
  Console console(out, err, ProgressStyle::kLines);
  const int code = runCommandLine(words, console, {});
  return {code, out.str(), err.str()};
}

TEST(CommandLine, TellsItsVersionAndItsWords) {
  EXPECT_THAT(gyre({"--version"}).out, HasSubstr("gyre 0."));
  const Answer help = gyre({"--help"});
  EXPECT_EQ(help.code, 0);
}

TEST(CommandLine, AnswersWrongWordsWithTwoAndASentence) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{}, {"frobnicate"}, {"--frobnicate"}}) {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("--help` lists the words."));
    EXPECT_EQ(answer.out, "");
  }
}

}  // namespace
}  // namespace gyre
