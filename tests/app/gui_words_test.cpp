// Which words ask for the window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui_words.h"

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

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

TEST(GuiWords, TakeAScreenshotOfAnObjectInATheme) {
  const auto options = guiOptions(
      {"--screenshot", "a.png", "--object", "vase", "--scene", "mesh", "--theme", "dark"});
  ASSERT_TRUE(options);
  EXPECT_EQ(options->object, "vase");
  EXPECT_EQ(options->theme, "dark");
  EXPECT_EQ(guiOptions({"--screenshot", "a.png", "--scene", "mesh"})->object, "duck");
  EXPECT_FALSE(guiOptions({"--screenshot", "a.png", "--scene", "mesh", "--object"}));
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

TEST(GuiWords, OpenAModelOfAnyKindThatIsRead) {
  const TempDir dir;
  for (const char* name : {"a.ply", "b.OBJ", "c.stl", "d.gyre"}) {
    const std::string file = putFile(dir / name, "").string();
    const auto options = guiOptions({file});
    ASSERT_TRUE(options) << name;
    EXPECT_EQ(options->open, file);
  }
  EXPECT_FALSE(guiOptions({putFile(dir / "e.txt", "").string()}));
}

}  // namespace
}  // namespace gyre
