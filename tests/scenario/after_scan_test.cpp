// What is done with a finished scan: measured, compared, reported, exported.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/formatted.h"
#include "core/io/model_file.h"
#include "core/io/picture_file.h"
#include "core/io/ply.h"
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
using testing::Not;

constexpr std::size_t kViews = 36;
constexpr double kWellSeen = 0.6;  // of the views that saw the best seen place

// One scan for all tests; none changes what another one looks at.
class AfterScan : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    temp_ = new TempDir;
    putFile(*temp_ / "rig.json", rigToJson(atImageWidth(RigSettings{}, 640)));
    const Answer scanned = gyre({"demo", "--rig", at("rig.json"), "--views", std::to_string(kViews),
                                 "--sim-speed", "100", "--out", at("duck")});
    ASSERT_EQ(scanned.code, 0) << scanned.err;
  }
  static void TearDownTestSuite() {
    delete temp_;
    temp_ = nullptr;
  }
  static std::string at(const std::string& name) { return (*temp_ / name).string(); }
  static nlohmann::json jsonIn(const std::string& name) {
    return nlohmann::json::parse(fileText(at(name)));
  }
  static void expectFailure(const std::vector<std::string>& words, int code,
                            const std::string& part) {
    const Answer answer = gyre(words);
    EXPECT_EQ(answer.code, code) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr(part));
    EXPECT_GE(std::count(answer.err.begin(), answer.err.end(), '.'), 2) << answer.err;
  }

  static TempDir* temp_;
};
TempDir* AfterScan::temp_ = nullptr;

std::string placeWord(const Eigen::Vector3d& place) {
  return formatted("%.3f,%.3f,%.3f", place.x(), place.y(), place.z());
}

// The two vertices of the true surface that lie farthest apart along the direction, of those that
// many views saw: what few of them saw is measured badly at 36 views.
std::pair<Eigen::Vector3d, Eigen::Vector3d> trueEnds(const Mesh& truth,
                                                     const Eigen::Vector3d& along) {
  std::pair<Eigen::Vector3d, Eigen::Vector3d> ends;
  double least = 1e9;
  double most = -1e9;
  int most_views = 0;
  for (const MeshVertex& vertex : truth.vertices) {
    most_views = std::max<int>(most_views, vertex.views);
  }
  for (const MeshVertex& vertex : truth.vertices) {
    if (vertex.views < kWellSeen * most_views) continue;
    const double at = along.dot(vertex.position);
    if (at < least) ends.first = vertex.position;
    if (at > most) ends.second = vertex.position;
    least = std::min(least, at);
    most = std::max(most, at);
  }
  return ends;
}

TEST_F(AfterScan, LengthsAreThoseOfTheTrueObject) {
  const auto truth = readMesh(at("duck/truth.ply"));
  ASSERT_TRUE(truth);
  fs::copy(at("duck"), at("measured"));  // files only, not the frames
  for (const Eigen::Vector3d& along :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0.3), Eigen::Vector3d(0.5, -0.5, 1)}) {
    const auto [from, to] = trueEnds(*truth, along);
    const double length_mm = (to - from).norm();
    const Answer answer =
        gyre({"measure", at("measured"), "--from", placeWord(from), "--to", placeWord(to),
              "--caliper", formatted("%.4f", length_mm), "--note", "a <b>"});
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.out, HasSubstr(" ± "));
    EXPECT_THAT(answer.out, HasSubstr("than the caliper"));
    const auto kept = jsonIn("measured/measurements.json").at("measurements").back();
    // Half a percent of the object: the surface at 640 pixels, and the ends' own slope.
    EXPECT_NEAR(kept.at("length_mm").get<double>(), length_mm, 0.4);
  }
  EXPECT_EQ(jsonIn("measured/measurements.json").at("measurements").size(), 3U);
  EXPECT_THAT(fileText(at("measured/report.html")), HasSubstr("a &lt;b&gt;"));
  const Answer listed = gyre({"measure", at("measured")});
  EXPECT_EQ(listed.code, 0);
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 3);
}

TEST_F(AfterScan, MeasuringSaysWhatIsWrongAndKeepsNothing) {
  const std::string duck = at("duck");
  expectFailure({"measure", duck, "--from", "900,0,0", "--to", "0,0,0"}, 1, "away from the model");
  expectFailure({"measure", duck, "--from", "-20,0,5"}, 2, "missing");
  expectFailure({"measure", at("rig.json"), "--from", "0,0,0", "--to", "1,0,0"}, 1, "rig.json");
  fs::create_directory(at("bare"));
  expectFailure({"measure", at("bare"), "--from", "0,0,0", "--to", "1,0,0"}, 1, "neither");
  EXPECT_FALSE(fs::exists(at("duck/measurements.json")));
  // A file is measured on, but nothing is kept beside it.
  const auto cloud = readPointCloud(at("duck/points.ply"));
  ASSERT_TRUE(cloud);
  const Answer answer =
      gyre({"measure", at("duck/mesh.ply"), "--from", placeWord(cloud->points[0].position), "--to",
            placeWord(cloud->points.back().position)});
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("does not say"));
  EXPECT_FALSE(fs::exists(at("duck/measurements.json")));
}

TEST_F(AfterScan, TheReportIsWholeAndTellsItsInputs) {
  const std::string html = fileText(at("duck/report.html"));
  for (const char* part :
       {"Demo: duck", "data:image/jpeg;base64,", "data:image/png;base64,", "From behind", "mm, ± ",
        "Gap after a full turn", "SHA-256", "36 views", "closed", "holds no verdict"}) {
    EXPECT_THAT(html, HasSubstr(part)) << part;
  }
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("class=\"doubt\">The file")));
  EXPECT_EQ(jsonIn("duck/report.json")
                .at("inputs")
                .at("SHA-256 of the pictures' list")
                .get<std::string>()
                .size(),
            64U);
  EXPECT_EQ(gyre({"report", at("duck")}).code, 0);
  EXPECT_EQ(fileText(at("duck/report.html")), html);
  expectFailure({"report", at("nowhere")}, 1, "report.json");
}

TEST_F(AfterScan, ComparingPaintsAndColours) {
  const Answer answer =
      gyre({"compare", at("duck/mesh.ply"), at("duck/truth.ply"), "--json", at("c.json"),
            "--picture", at("c.png"), "--colours", at("c.ply"), "--verbose"});
  ASSERT_EQ(answer.code, 0) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("How often"));
  double all = 0.0;
  const auto numbers = jsonIn("c.json");
  for (const auto& bin : numbers.at("histogram_mm")) all += bin.at("share").get<double>();
  EXPECT_NEAR(all, 1.0, 1e-9);
  const auto coloured = readMesh(at("c.ply"));
  ASSERT_TRUE(coloured);
  EXPECT_EQ(coloured->triangles.size(), readMesh(at("duck/mesh.ply"))->triangles.size());
  const auto picture = readPicture(at("c.png"));
  ASSERT_TRUE(picture);
  EXPECT_GT(picture->image_bgr.cols, 1000);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(picture->image_bgr, mean, deviation);
  EXPECT_GT(deviation[0], 20.0);  // not a white sheet
}

TEST_F(AfterScan, ComparingNamesTheUnitOfAForeignReference) {
  auto truth = readMesh(at("duck/truth.ply"));
  ASSERT_TRUE(truth);
  for (MeshVertex& vertex : truth->vertices) vertex.position *= 1e-3;
  ASSERT_TRUE(writePly(at("metres.ply"), *truth));
  expectFailure({"compare", at("duck/mesh.ply"), at("metres.ply")}, 1, "in metres");
  expectFailure({"compare", at("duck/mesh.ply"), at("metres.ply"), "--picture", "a.jpg"}, 2,
                ".png");
  expectFailure({"compare", at("duck/mesh.ply"), at("metres.ply"), "--colours", "a.obj"}, 2,
                ".ply");
}

// Read by COLMAP's documentation and projected by OpenCV, points are where the pictures show them.
TEST_F(AfterScan, ColmapFindsThePointsInThePictures) {
  const Answer answer = gyre({"export", at("duck"), "--to", "colmap", "--out", at("colmap")});
  ASSERT_EQ(answer.code, 0) << answer.err;
  const test::ColmapModel model = test::readColmap(*temp_ / "colmap" / "sparse" / "0");
  ASSERT_EQ(model.images.size(), kViews);
  std::size_t masks = 0;
  for (const auto& [id, image] : model.images) {
    const auto picture = readPicture(*temp_ / "colmap" / "images" / image.name);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->image_bgr.cols, model.cameras.at(1).width);
    masks += fs::exists(*temp_ / "colmap" / "masks" / (image.name + ".png")) ? 1 : 0;
  }
  EXPECT_GT(masks, kViews / 2);
  double squares = 0.0;
  std::size_t count = 0;
  for (const auto& [id, point] : model.points) {
    for (const auto& [image, place] : point.track) {
      const test::ColmapImage& seen_in = model.images.at(image);
      const cv::Point2d off = seen_in.points.at(place).first -
                              test::projected(model.cameras.at(1), seen_in, point.position);
      squares += off.dot(off);
      ++count;
    }
  }
  const auto report = jsonIn("duck/report.json");
  EXPECT_EQ(model.points.size(), report.at("points").get<std::size_t>());
  EXPECT_EQ(count, report.at("observations").get<std::size_t>());
  // points.ply and sightings.bin hold floats: a thousandth of a pixel.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), report.at("rms_px").get<double>(),
              2e-3);
}

TEST_F(AfterScan, TransformsNameThePicturesAndMayLinkThem) {
  const Answer answer =
      gyre({"export", at("duck/duck.gyre"), "--to", "transforms", "--link", "--out", at("nerf")});
  ASSERT_EQ(answer.code, 0) << answer.err;
  const auto root = jsonIn("nerf/transforms.json");
  ASSERT_EQ(root.at("frames").size(), kViews);
  for (const auto& frame : root.at("frames")) {
    const fs::path file = *temp_ / "nerf" / frame.at("file_path").get<std::string>();
    EXPECT_TRUE(fs::is_symlink(file));
    EXPECT_TRUE(readPicture(file));
    // The cameras stand around the object, as far off as the rig's.
    const auto& rows = frame.at("transform_matrix");
    const Eigen::Vector3d centre(rows[0][3], rows[1][3], rows[2][3]);
    EXPECT_NEAR(centre.norm(), 350.0, 40.0);
  }
  // Once more over itself, and with the pictures gone.
  EXPECT_EQ(gyre({"export", at("duck"), "--to", "transforms", "--out", at("nerf")}).code, 0);
  EXPECT_FALSE(fs::is_symlink(*temp_ / "nerf" / "images" / "view_0000.png"));
  fs::copy(at("duck"), at("lean"));
  expectFailure({"export", at("lean"), "--to", "colmap", "--out", at("x")}, 1, "--images");
  EXPECT_EQ(gyre({"export", at("lean"), "--to", "colmap", "--out", at("x"), "--images",
                  at("duck/frames"), "--link"})
                .code,
            0);
  expectFailure({"export", at("bare2"), "--to", "colmap", "--out", at("x")}, 1, "points.ply");
  expectFailure({"export", at("duck"), "--to", "blender", "--out", at("x")}, 2, "blender");
}

}  // namespace
}  // namespace gyre
