// The commands on the simulated rig, and what they say to wrong use and bad files.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command_line.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/scan_store.h"
#include "core/sim/rig_json.h"
#include "tests/support/command_answer.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;
using test::Answer;
using test::gyre;
using ::testing::HasSubstr;

class Commands : public testing::Test {
 protected:
  Commands() { putFile(temp_ / "rig.json", rigToJson(atImageWidth(RigSettings{}, 320))); }
  std::string at(const std::string& name) const { return (temp_ / name).string(); }

  // The demo's or the scan's words for six small views.
  std::vector<std::string> sixViews(std::vector<std::string> words, const std::string& out) const {
    for (const std::string& word : std::vector<std::string>{
             "--rig", at("rig.json"), "--views", "6", "--sim-speed", "100", "--out", at(out)}) {
      words.push_back(word);
    }
    return words;
  }
  Answer scan(const std::string& out) const {
    return gyre(sixViews({"scan", "--turntable", "sim", "--camera", "sim"}, out));
  }
  void expectFailure(const std::vector<std::string>& words, int code,
                     const std::string& part) const {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, code) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr(part));
    // What happened, and what to try.
    EXPECT_GE(std::count(answer.err.begin(), answer.err.end(), '.'), 2) << answer.err;
  }

  TempDir temp_;
};

TEST_F(Commands, DemoWritesEverythingAndTheTruth) {
  const Answer answer = gyre(sixViews({"demo", "--object", "mouse"}, "demo"));
  EXPECT_EQ(answer.code, 1);  // six views are too few
  EXPECT_THAT(answer.err, HasSubstr("Take more views"));
  for (const char* file :
       {"demo.gyre", "journal.jsonl", "calibration.json", "angles.csv", "angles_solved.csv",
        "points.ply", "visibility.bin", "report.json", "report.html", "truth.ply", "truth.json"}) {
    EXPECT_TRUE(fs::exists(temp_ / "demo" / file)) << file;
  }
  const auto truth = nlohmann::json::parse(fileText(temp_ / "demo" / "truth.json"));
  EXPECT_EQ(truth.at("angles_deg").size(), 6U);
  EXPECT_EQ(truth.at("angles_deg").begin().value(), 0.0);
  EXPECT_EQ(truth.at("seed"), 1);
  EXPECT_TRUE(truth.contains("calibration") && truth.contains("rig"));
  const auto report = nlohmann::json::parse(fileText(temp_ / "demo" / "report.json"));
  EXPECT_TRUE(report.at("seconds").contains("render"));
}

TEST_F(Commands, DemoTouchesNoFolderThatHoldsSomething) {
  fs::create_directory(temp_ / "full");
  putFile(temp_ / "full" / "letter.txt", "dear");
  const Answer answer = gyre(sixViews({"demo"}, "full"));
  EXPECT_EQ(answer.code, 1);
  EXPECT_EQ(std::distance(fs::directory_iterator(temp_ / "full"), {}), 1);
}

TEST_F(Commands, ScanIsResumedOnlyWhenThereIsSomethingToDo) {
  const Answer scanned = scan("scan");
  EXPECT_THAT(scanned.out, HasSubstr("points from"));
  const Answer again = gyre({"resume", at("scan")});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.out, HasSubstr("nothing to do"));
}

TEST_F(Commands, ScanStopsOnRequest) {
  std::stop_source stop;
  stop.request_stop();
  const Answer stopped =
      gyre(sixViews({"scan", "--turntable", "sim", "--camera", "sim"}, "scan"), stop.get_token());
  EXPECT_EQ(stopped.code, 130);
}

TEST_F(Commands, ResumeMovesNothingWhereItDoesNotKnowTheTable) {
  (void)scan("scan");
  // The last views are lost, and another object stands on the table.
  const std::string journal = fileText(temp_ / "scan" / "journal.jsonl");
  putFile(temp_ / "scan" / "journal.jsonl", journal.substr(0, journal.size() / 2));
  std::string settings = fileText(temp_ / "scan" / "scan.gyre");
  const std::size_t seed = settings.find("\"seed\": 1");
  ASSERT_NE(seed, std::string::npos);
  putFile(temp_ / "scan" / "scan.gyre", settings.replace(seed, 9, "\"seed\": 2"));
  const std::size_t views = ScanStore::open(temp_ / "scan")->views().size();
  ASSERT_LT(views, 6U);
  expectFailure({"resume", at("scan")}, 1, "nothing was moved");
  EXPECT_EQ(ScanStore::open(temp_ / "scan")->views().size(), views);
}

TEST_F(Commands, BadInputIsASentence) {
  const std::string out = at("out");
  putFile(temp_ / "not.ply", "no mesh at all");
  putFile(temp_ / "bad_rig.json", R"({"no_such_key": 1})");
  expectFailure({"reconstruct", at("nowhere"), "--out", out}, 1, "nowhere");
  expectFailure({"resume", at("nowhere")}, 1, "nowhere");
  expectFailure({"compare", at("nowhere.ply"), at("nowhere.ply")}, 1, "nowhere.ply");
  expectFailure({"compare", at("not.ply"), at("not.ply")}, 1, "not.ply");
  expectFailure({"mesh", at("not.ply"), "--out", at("mesh.ply")}, 1, "not.ply");
  expectFailure({"mesh", at("not.ply"), "--out", at("mesh.doc")}, 2, "mesh.doc");
  expectFailure({"demo", "--rig", at("bad_rig.json"), "--out", out}, 2, "no_such_key");
  expectFailure({"demo", "--object", "elephant", "--out", out}, 2, "elephant");
  expectFailure({"scan", "--turntable", "sim:elephant", "--camera", "sim", "--out", out}, 1,
                "elephant");
  expectFailure({"scan", "--turntable", "/dev/nothing", "--camera", "0", "--out", out}, 1,
                "--calibration");
  expectFailure({"scan", "--turntable", "sim", "--camera", "sim", "--axis", "Q", "--out", out}, 1,
                "\"Q\"");
  expectFailure({"reconstruct", at("nowhere"), "--step-deg", "wide", "--out", out}, 2, "wide");
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Commands, DevicesAreListedAsJson) {
  const Answer answer = gyre({"devices", "--json", "--quiet"});
  EXPECT_EQ(answer.code, 0);
  const auto listed = nlohmann::json::parse(answer.out);
  EXPECT_TRUE(listed.at("ports").is_array());
  EXPECT_TRUE(listed.at("cameras").is_array());
}

TEST_F(Commands, CompareWritesItsNumbers) {
  (void)gyre(sixViews({"demo"}, "demo"));
  const std::string truth = at("demo/truth.ply");
  const Answer answer = gyre({"compare", truth, truth, "--json", at("c.json"), "--at", "0.5,2"});
  ASSERT_EQ(answer.code, 0) << answer.err;
  const auto numbers = nlohmann::json::parse(fileText(temp_ / "c.json"));
  EXPECT_LT(numbers.at("accuracy_mm").at("p95"), 1e-6);
  ASSERT_EQ(numbers.at("at_mm").size(), 2U);
  EXPECT_EQ(numbers.at("at_mm")[1].at("d"), 2.0);
  EXPECT_EQ(numbers.at("at_mm")[1].at("completeness"), 1.0);
}

TEST_F(Commands, ScanTellsAtWhichViewTheCameraWasBumped) {
  RigSettings rig = atImageWidth(RigSettings{}, 640);
  rig.bump_px = 2.0;
  rig.bump_at_deg = 180.0;
  putFile(temp_ / "bumped.json", rigToJson(rig));
  const Answer answer =
      gyre({"scan", "--turntable", "sim", "--camera", "sim", "--rig", at("bumped.json"), "--views",
            "24", "--sim-speed", "100", "--out", at("bumped")});
  EXPECT_THAT(answer.err, HasSubstr("bumped")) << answer.out;
  EXPECT_THAT(answer.err, HasSubstr("from view 13 on"));
  const auto report = nlohmann::json::parse(fileText(temp_ / "bumped" / "report.json"));
  const auto& views = report.at("drift").at("views");
  ASSERT_EQ(views.size(), 24U);
  for (std::size_t i = 1; i < views.size(); ++i) {
    EXPECT_EQ(views[i].at("moved"), i >= 12) << i;
    ASSERT_TRUE(views[i].at("px").is_number()) << i;
    EXPECT_NEAR(views[i].at("px").get<double>(), i >= 12 ? 2.0 : 0.0, 0.1) << i;
  }
}

}  // namespace
}  // namespace gyre
