// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/passes_file.h"

#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

std::vector<ScanPass> sample() {
  ScanPass first{"pass-1", "/scans/duck \"upright\"", 200, {}, {}};
  ScanPass second{"pass-2", "../über/duck", 72, {}, PassFit{311, 0.12, 0.4, 0.015}};
  second.merged_from_pass.rotation =
      Eigen::AngleAxisd(3.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  second.merged_from_pass.translation = {1.0 / 3.0, -20.5, 63.25};
  return {first, second};
}

void expectSame(const std::vector<ScanPass>& read, const std::vector<ScanPass>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].name, written[i].name);
    EXPECT_EQ(read[i].folder, written[i].folder);
    EXPECT_EQ(read[i].views, written[i].views);
    EXPECT_EQ(read[i].merged_from_pass.rotation, written[i].merged_from_pass.rotation);
    EXPECT_EQ(read[i].merged_from_pass.translation, written[i].merged_from_pass.translation);
    ASSERT_EQ(read[i].fit.has_value(), written[i].fit.has_value());
    if (!read[i].fit) continue;
    EXPECT_EQ(read[i].fit->spots, written[i].fit->spots);
    EXPECT_EQ(read[i].fit->spots_mm, written[i].fit->spots_mm);
    EXPECT_EQ(read[i].fit->overlap, written[i].fit->overlap);
    EXPECT_EQ(read[i].fit->residual_mm, written[i].fit->residual_mm);
  }
}

TEST(PassesFile, IsReadAsItWasWritten) {
  const auto read = parsePasses(passesText(sample()), "p");
  ASSERT_TRUE(read) << read.error().what;
  expectSame(*read, sample());
}

TEST(PassesFile, CountsARelativeFolderFromItsOwn) {
  const TempDir dir;
  ASSERT_TRUE(writePasses(dir / "passes.json", sample()));
  const auto read = readPasses(dir / "passes.json");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ((*read)[1].folder, (dir.path() / "../über/duck").lexically_normal());
}

TEST(PassesFile, RefusesInASentenceWhatIsMalformed) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = passesText(sample());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const auto read = parsePasses(text, "passes.json");
    return read ? std::string("was read") : read.error().what;
  };
  EXPECT_THAT(changed("gyre-passes", "gyre-targets"), HasSubstr("format"));
  EXPECT_THAT(changed("\"version\": 1", "\"version\": 2"), HasSubstr("version"));
  EXPECT_THAT(changed("\"pass-2\"", "\"../pass-2\""), HasSubstr("name of a pass"));
  EXPECT_THAT(changed("\"pass-2\"", "\"..\""), HasSubstr("name of a pass"));
  EXPECT_THAT(changed("\"overlap\": 0.4", "\"overlap\": 1.4"), HasSubstr("overlap"));
  EXPECT_THAT(changed("\"views\": 72", "\"views\": -1"), HasSubstr("views"));
  EXPECT_THAT(changed("63.25", "1e300"), HasSubstr("merged_from_pass"));
  EXPECT_THAT(changed("1.0,", "0.7,"), HasSubstr("rotation"));
  EXPECT_FALSE(parsePasses("", "p"));
  EXPECT_FALSE(parsePasses("{}", "p"));
  EXPECT_FALSE(parsePasses("[]", "p"));
  EXPECT_FALSE(readPasses("/nowhere/passes.json"));
}

TEST(PassesFile, SurvivesMutations) {
  const std::string text = passesText(sample());
  for (int i = 0; i < 3000; ++i) {
    const auto read = parsePasses(mutated(text, static_cast<std::uint64_t>(i)), "p");
    if (!read) {
      EXPECT_FALSE(read.error().what.empty());
    }
  }
}

}  // namespace
}  // namespace gyre
