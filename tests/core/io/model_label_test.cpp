// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_label.h"

#include <gtest/gtest.h>

#include "core/io/scan_settings_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

TEST(WritableLabel, KeepsWhatPeopleWrite) {
  const ModelLabel label = writableLabel({"Vase \"№ 7\" & <jug>", "MK 1904/12\\b", "© Müller"});
  EXPECT_EQ(label.title, "Vase \"№ 7\" & <jug>");
  EXPECT_EQ(label.inventory_number, "MK 1904/12\\b");
  EXPECT_EQ(label.rights, "© Müller");
}

TEST(WritableLabel, ReplacesWhatNoFileCanHold) {
  const ModelLabel label = writableLabel({std::string("a\0b\nc\x7f", 6), "\xff\xc3", ""});
  EXPECT_EQ(label.title, "a b c ");
  EXPECT_EQ(label.inventory_number, "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(label.rights, "");
}

TEST(LabelOfScan, IsThatOfTheScanInWhoseFolderAModelLies) {
  const TempDir dir;
  ScanSettings settings;
  settings.title = "Jug";
  settings.inventory_number = "MK 7";
  settings.rights = "CC0";
  const auto file = putFile(dir / "jug.gyre", *scanSettingsText(settings));
  for (const auto& path : {dir.path(), file, dir / "points.ply"}) {
    const ModelLabel label = labelOfScan(path);
    EXPECT_EQ(label.title, "Jug") << path;
    EXPECT_EQ(label.inventory_number, "MK 7");
    EXPECT_EQ(label.rights, "CC0");
  }
}

TEST(LabelOfScan, IsEmptyWhereThereIsNoScan) {
  const TempDir dir;
  EXPECT_EQ(labelOfScan(dir.path()).title, "");
  EXPECT_EQ(labelOfScan(dir / "nowhere/points.ply").title, "");
  EXPECT_EQ(labelOfScan(putFile(dir / "a.gyre", "nothing")).title, "");
}

}  // namespace
}  // namespace gyre
