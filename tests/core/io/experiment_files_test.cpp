// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/experiment_files.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

ExperimentTable sample() {
  ExperimentTable table;
  table.name = "table1";
  table.caption = "Errors & <noise>.";
  table.columns = {
      {"noise_px", "noise"}, {"views", "views"}, {"ri_mm", "RI"}, {"paper_mm", "paper"}};
  table.rows = {{0.0, 5.0, 3.0, std::nullopt},
                {0.0, 20.0, 0.375, 0.38},
                {1.0, 5.0, 10.5, std::nullopt},
                {1.0, 20.0, std::nullopt, std::nullopt}};
  table.drawing.across = 1;
  table.drawing.panels_by = 0;
  table.drawing.measured = {2};
  table.drawing.compared = {3};
  table.drawing.across_label = "views of a point";
  table.drawing.up_label = "error [mm]";
  return table;
}

int countOf(const std::string& text, const std::string& word) {
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(ExperimentCsv, LeavesEmptyCellsEmpty) {
  EXPECT_EQ(csvOf(sample()),
            "noise_px,views,ri_mm,paper_mm\n0,5,3,\n0,20,0.375,0.38\n1,5,10.5,\n1,20,,\n");
}

TEST(ExperimentJson, HoldsEveryNumberUnderItsKey) {
  const auto json = nlohmann::json::parse(jsonOf(sample()));
  EXPECT_EQ(json["name"], "table1");
  EXPECT_EQ(json["caption"], "Errors & <noise>.");
  EXPECT_EQ(json["columns"]["ri_mm"], "RI");
  ASSERT_EQ(json["rows"].size(), 4U);
  EXPECT_EQ(json["rows"][1]["ri_mm"], 0.375);
  EXPECT_TRUE(json["rows"][3]["ri_mm"].is_null());
}

TEST(ExperimentSvg, DrawsAPanelANoiseAndAMarkACell) {
  const std::string svg = svgOf(sample());
  EXPECT_THAT(svg, HasSubstr("noise 0"));
  EXPECT_THAT(svg, HasSubstr("noise 1"));
  EXPECT_THAT(svg, HasSubstr("Errors &amp; &lt;noise&gt;."));
  EXPECT_THAT(svg, HasSubstr("views of a point"));
  EXPECT_THAT(svg, HasSubstr("error [mm]"));
  EXPECT_EQ(countOf(svg, "<circle"), 3 + 1);  // three cells, and the legend
  EXPECT_EQ(countOf(svg, "<polyline"), 3);    // RI twice, the paper's once
}

TEST(ExperimentSvg, IsAnEmptySheetForAnEmptyTable) {
  ExperimentTable table = sample();
  table.rows.clear();
  EXPECT_THAT(svgOf(table), Not(HasSubstr("polyline")));
  EXPECT_THAT(svgOf(table), HasSubstr("</svg>"));
}

TEST(WriteExperiment, WritesAllThreeAndNamesAFolderThatCannotBe) {
  const TempDir temp;
  ASSERT_TRUE(writeExperiment(temp / "a/b", sample()));
  for (const char* ending : {".csv", ".json", ".svg"}) {
    const auto file = std::filesystem::path(temp / "a/b") / (std::string("table1") + ending);
    EXPECT_TRUE(std::filesystem::exists(file));
  }
  std::ofstream(temp / "file") << "x";
  const auto failed = writeExperiment(temp / "file", sample());
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().sentence(), HasSubstr("file"));
}

}  // namespace
}  // namespace gyre
