// Which words ask for the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui_words.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(GuiWords, OpenTheWindowWhenThereAreNone) {
  const auto options = guiOptions({});
  ASSERT_TRUE(options);
  EXPECT_TRUE(options->screenshot.empty());
}

TEST(GuiWords, TakeAScreenshotInEitherOrder) {
  for (const auto& words : {std::vector<std::string>{"--screenshot", "a.png", "--scene", "mesh"},
                            std::vector<std::string>{"--scene", "mesh", "--screenshot", "a.png"}}) {
    const auto options = guiOptions(words);
    ASSERT_TRUE(options);
    EXPECT_EQ(options->screenshot, "a.png");
    EXPECT_EQ(options->scene, "mesh");
  }
}

TEST(GuiWords, LeaveCommandsAlone) {
  EXPECT_FALSE(guiOptions({"demo", "--out", "x"}));
  EXPECT_FALSE(guiOptions({"--help"}));
  EXPECT_FALSE(guiOptions({"--screenshot", "a.png"}));
  EXPECT_FALSE(guiOptions({"no-such-file.ply"}));
}

TEST(GuiWords, OpenAFolder) {
  const auto options = guiOptions({"."});
  ASSERT_TRUE(options);
  EXPECT_EQ(options->open, ".");
}

}  // namespace
}  // namespace gyre
