// The program where 0.5 is written 0,5: a window sets that country's locale for all of the process.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/comma_locale.h"

namespace gyre {
namespace {

int gyreProgram(const std::string& words) {
  return std::system(("QT_QPA_PLATFORM=offscreen '" GYRE_PROGRAM "' " + words).c_str());
}

// What is written on the sheets.
std::string wordsOf(const std::filesystem::path& pdf) {
  const auto text = std::filesystem::path(pdf).replace_extension(".txt");
  EXPECT_EQ(std::system(("pdftotext '" + pdf.string() + "' '" + text.string() + "'").c_str()), 0);
  const std::string words = fileText(text);
  EXPECT_NE(words.find("mm"), std::string::npos);
  return words;
}

TEST(CommaLocale, TheWindowFindsItsRigAndTurnsIt) {
  const test::CommaLocale germany;
  ASSERT_TRUE(germany.made());
  const TempDir folder;
  // The page of the turn shows pictures taken of a table that turned.
  const auto picture = folder / "turn.png";
  EXPECT_EQ(gyreProgram("--screenshot '" + picture.string() + "' --scene turn"), 0);
  EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST(CommaLocale, APrintedTargetIsTheSameInEveryCountry) {
  const TempDir here;
  const TempDir there;
  const std::string words = "print-target --quiet --page a4 --target ring --out ";
  ASSERT_EQ(gyreProgram(words + here.path().string()), 0);
  {
    const test::CommaLocale germany;
    ASSERT_TRUE(germany.made());
    ASSERT_EQ(gyreProgram(words + there.path().string()), 0);
  }
  ASSERT_FALSE(std::filesystem::is_empty(here.path()));
  for (const auto& file : std::filesystem::directory_iterator(here.path())) {
    if (file.path().extension() != ".json") continue;  // a PDF holds its time of day
    EXPECT_EQ(fileText(file.path()), fileText(there / file.path().filename().string()));
  }
  EXPECT_EQ(wordsOf(here / "ring.pdf"), wordsOf(there / "ring.pdf"));
}

}  // namespace
}  // namespace gyre
