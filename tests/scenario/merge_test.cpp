// An object that is scanned upright, turned over, and scanned again: one model of both.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/model_file.h"
#include "core/io/passes_file.h"
#include "core/mesh/compare.h"
#include "core/mesh/mesh_health.h"
#include "core/sim/objects.h"
#include "core/sim/rig_json.h"
#include "tests/support/colmap_reader.h"
#include "tests/support/command_answer.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;
using test::Answer;
using test::gyre;
using testing::HasSubstr;

constexpr int kViews = 36;

RigSettings rigOf(double roll_deg, double yaw_deg) {
  RigSettings rig = atImageWidth(RigSettings{}, 640);
  rig.object_roll_deg = roll_deg;
  rig.object_yaw_deg = yaw_deg;
  return rig;
}

// Two scans of the duck and what merging them gave, for all tests.
class MergedDuck : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    temp_ = new TempDir;
    scan("upright", "duck", rigOf(0.0, 0.0));
    scan("over", "duck", rigOf(180.0, 50.0));
    const Answer merged = gyre({"merge", at("upright"), at("over"), "--out", at("merged")});
    ASSERT_EQ(merged.code, 0) << merged.err;
    told_ = merged.out;
  }
  static void TearDownTestSuite() {
    delete temp_;
    temp_ = nullptr;
  }
  static void scan(const std::string& name, const std::string& object, const RigSettings& rig,
                   int views = kViews) {
    putFile(*temp_ / (name + ".json"), rigToJson(rig));
    const Answer scanned = gyre({"demo", "--object", object, "--rig", at(name + ".json"), "--views",
                                 std::to_string(views), "--sim-speed", "100", "--out", at(name)});
    ASSERT_EQ(scanned.code, 0) << scanned.err;
  }
  static std::string at(const std::string& name) { return (*temp_ / name).string(); }

  static TempDir* temp_;
  static std::string told_;
};
TempDir* MergedDuck::temp_ = nullptr;
std::string MergedDuck::told_;

Mesh meshIn(const std::string& file) { return std::get<Mesh>(*readMeshOrCloud(file)); }

// As both passes together saw the true surface: its vertices are the same ones, in the same order.
Mesh truthOfBoth(const std::string& upright, const std::string& over) {
  Mesh truth = meshIn(upright + "/truth.ply");
  const Mesh other = meshIn(over + "/truth.ply");
  EXPECT_EQ(truth.vertices.size(), other.vertices.size());
  for (std::size_t i = 0; i < truth.vertices.size(); ++i) {
    truth.vertices[i].views =
        static_cast<std::uint16_t>(truth.vertices[i].views + other.vertices[i].views);
  }
  return truth;
}

TEST_F(MergedDuck, LiesAsItTrulyDid) {
  const auto passes = readPasses(at("merged/passes.json"));
  ASSERT_TRUE(passes) << passes.error().what;
  ASSERT_EQ(passes->size(), 2U);
  const SimObject over(rigOf(180.0, 50.0));
  double miss_mm = 0.0;
  for (const MeshVertex& vertex : over.mesh().vertices) {
    const Eigen::Vector3d truly = over.uprightFromTable() * vertex.position;
    miss_mm = std::max(miss_mm, ((*passes)[1].merged_from_pass * vertex.position - truly).norm());
  }
  EXPECT_LT(miss_mm, 0.2);
  ASSERT_TRUE((*passes)[1].fit);
  EXPECT_LT((*passes)[1].fit->residual_mm, 0.05);
  EXPECT_GT((*passes)[1].fit->overlap, 0.2);
  EXPECT_THAT(told_, HasSubstr("spots of its surface were found again"));
}

TEST_F(MergedDuck, IsWholeAndAsExactAsOnePass) {
  const Mesh truth_of_one = meshIn(at("upright/truth.ply"));
  const auto one = compareSurfaces(meshIn(at("upright/mesh.ply")), truth_of_one,
                                   judgingOptions(truth_of_one), {});
  ASSERT_TRUE(one);
  const Mesh truth = truthOfBoth(at("upright"), at("over"));
  const Mesh merged = meshIn(at("merged/mesh.ply"));
  CompareOptions options = judgingOptions(truth);
  options.min_height_mm = -1.0;  // the base counts, too
  options.at_mm = {0.8};
  const auto both = compareSurfaces(merged, truth, options, {});
  ASSERT_TRUE(both);
  EXPECT_LE(both->mean_mm, 1.5 * one->mean_mm);
  EXPECT_GE(both->at.front().completeness, 0.98);
  const MeshHealth health = meshHealth(merged);
  EXPECT_TRUE(health.closed);
  EXPECT_EQ(health.euler_number, 2);
  EXPECT_LT(health.unseen_area_mm2, 0.02 * health.area_mm2);

  // The base, of which one pass sees nothing: its middle is where it is, and was seen.
  const auto is_base = [](const MeshVertex& vertex) {
    return vertex.position.z() < 0.5 && vertex.normal.z() < -0.9;
  };
  const auto seen =
      std::count_if(merged.vertices.begin(), merged.vertices.end(),
                    [&](const MeshVertex& vertex) { return is_base(vertex) && vertex.seen != 0; });
  EXPECT_GT(seen, 50);
}

TEST_F(MergedDuck, IsAResultLikeAnyOther) {
  const Answer hull =
      gyre({"mesh", at("merged"), "--method", "silhouette", "--out", at("hull.ply")});
  ASSERT_EQ(hull.code, 0) << hull.err;
  EXPECT_THAT(hull.out, HasSubstr("closed"));
  const Answer exported = gyre({"export", at("merged"), "--to", "colmap", "--out", at("colmap")});
  ASSERT_EQ(exported.code, 0) << exported.err;
  const test::ColmapModel model = test::readColmap(at("colmap/sparse/0"));
  EXPECT_EQ(model.cameras.size(), 1U);
  EXPECT_EQ(model.images.size(), 2U * kViews);
  EXPECT_TRUE(fs::exists(at("colmap/images/pass-2") + "/" +
                         fs::path(model.images.at(2 * kViews).name).filename().string()));
  std::vector<double> off_px;
  for (const auto& [id, point] : model.points) {
    for (const auto& [image_id, place] : point.track) {
      const test::ColmapImage& image = model.images.at(image_id);
      off_px.push_back(cv::norm(image.points[place].first -
                                test::projected(model.cameras.at(1), image, point.position)));
    }
  }
  ASSERT_GT(off_px.size(), 10000U);
  std::nth_element(off_px.begin(), off_px.begin() + static_cast<std::ptrdiff_t>(off_px.size() / 2),
                   off_px.end());
  EXPECT_LT(off_px[off_px.size() / 2], 0.3);
  const auto report = nlohmann::json::parse(fileText(at("merged/report.json")));
  EXPECT_THAT(report["inputs"]["pass-2"].get<std::string>(), HasSubstr("overlaps"));
  EXPECT_TRUE(fs::exists(at("merged/report.html")));
}

TEST_F(MergedDuck, IsNotMadeOfAnythingElse) {
  const auto expect_refusal = [](const std::vector<std::string>& words, const std::string& part) {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, 1) << answer.out;
    EXPECT_THAT(answer.err, HasSubstr(part));
  };
  scan("mouse", "mouse", rigOf(0.0, 0.0), 18);
  expect_refusal({"merge", at("upright"), at("mouse"), "--out", at("nothing")}, "mouse");
  EXPECT_FALSE(fs::exists(at("nothing")));
  expect_refusal({"merge", at("upright"), at("upright"), "--out", at("nothing")}, "twice");
  expect_refusal({"merge", at("upright"), at("over"), "--out", at("over")}, "written over");
  expect_refusal({"merge", at("merged"), at("over"), "--out", at("nothing")}, "itself merged");
  expect_refusal({"merge", at("upright"), at("nowhere"), "--out", at("nothing")}, "nowhere");
  fs::rename(at("over/frames"), at("over/elsewhere"));
  expect_refusal({"merge", at("upright"), at("over"), "--out", at("nothing")}, "missing");
  fs::rename(at("over/elsewhere"), at("over/frames"));
  EXPECT_FALSE(fs::exists(at("nothing")));
}

}  // namespace
}  // namespace gyre
