// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/clean_mesh.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/mesh/clean/check_input.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "tests/support/solids.h"
#include "tests/support/surfaces.h"

namespace gyre {
namespace {

using ::testing::ElementsAre;

// A noisy dome that reaches below the platter, with a hole in its side, a crumb beside it and a
// piece of platter around it.
Mesh roughScan() {
  Mesh dome = test::ballMesh(20.0, 96);
  Random random(3);
  for (MeshVertex& vertex : dome.vertices) {
    vertex.position *= 1.0 + 0.05 * random.gaussian() / 20.0;
    vertex.position.z() += 10.0;
    vertex.sigma_mm = 0.05F;
    vertex.views = 9;
    vertex.rgb = {90, 60, 30};
  }
  std::erase_if(dome.triangles, [&](const Triangle& triangle) {
    const Eigen::Vector3d& corner = dome.vertices[triangle[0]].position;
    return corner.x() > 0.0 && std::hypot(corner.y(), corner.z() - 15.0) < 2.5;
  });
  Mesh platter = test::squareMesh(300.0, 0.0);
  std::erase_if(platter.triangles, [&](const Triangle& triangle) {
    return platter.vertices[triangle[0]].position.norm() < 100.0;
  });
  Mesh crumb = test::tetrahedronMesh({0, 0, 40}, 0.5);
  return test::joined(test::joined(dome, platter), crumb);
}

std::vector<std::string> namesOf(const CleanReport& report) {
  std::vector<std::string> names;
  for (const CleanStep& step : report.steps) names.push_back(step.name);
  return names;
}

double figure(const CleanReport& report, const std::string& step, const std::string& what) {
  for (const CleanStep& done : report.steps) {
    if (done.name != step) continue;
    for (const CleanFigure& figure : done.figures) {
      if (figure.what == what) return figure.value;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

CleanOptions everything() {
  CleanOptions options;
  options.crop.radius_mm = 60.0;
  options.holes.max_width_mm = 15.0;
  options.base_cap = true;
  options.smooth.iterations = 5;
  options.decimate.triangles = 4000;
  options.remesh.edge_mm = 1.5;
  return options;
}

TEST(CleanMesh, MakesARoughScanPrintable) {
  const auto cleaned = cleanMesh(roughScan(), everything(), {});
  ASSERT_TRUE(cleaned);
  EXPECT_TRUE(checkSurface(cleaned->mesh));
  EXPECT_EQ(cleaned->report.after.genus, 0);
  EXPECT_EQ(*countSelfIntersections(cleaned->mesh, {}), 0U);
  // A ball of 20 mm whose lowest 10 mm are cut off: pi h^2 (3 r - h) / 3 with h = 30.
  EXPECT_NEAR(cleaned->report.after.volume_mm3, 28274.0, 150.0);
  EXPECT_NEAR(boundsOf(cleaned->mesh).min.z(), 0.0, 1e-9);
  EXPECT_NEAR(boundsOf(cleaned->mesh).max.z(), 30.0, 0.2);
  const double unseen_mm2 = cleaned->report.after.unseen_area_mm2;
  EXPECT_GT(unseen_mm2, kPi * 300.0);  // the base, and the hole
  EXPECT_LT(unseen_mm2, kPi * 300.0 + 150.0);
}

TEST(CleanMesh, TellsWhatEveryStepDid) {
  const auto cleaned = cleanMesh(roughScan(), everything(), {});
  ASSERT_TRUE(cleaned);
  const CleanReport& report = cleaned->report;
  EXPECT_THAT(namesOf(report),
              ElementsAre("Merge", "Small pieces", "Separate", "Orient", "Crop", "Small pieces",
                          "Fill holes", "Base", "Smooth", "Reduce", "Remesh"));
  for (std::size_t i = 1; i < report.steps.size(); ++i) {
    EXPECT_EQ(report.steps[i].triangles_before, report.steps[i - 1].triangles_after);
  }
  EXPECT_EQ(report.before.components, 3U);
  EXPECT_EQ(figure(report, "Small pieces", "pieces removed"), 1.0);
  EXPECT_EQ(figure(report, "Fill holes", "holes filled"), 1.0);
  EXPECT_EQ(figure(report, "Base", "rims closed"), 1.0);
  EXPECT_LE(figure(report, "Smooth", "largest move"), 0.3);
  EXPECT_EQ(report.steps.back().triangles_after, cleaned->mesh.triangles.size());
}

TEST(CleanMesh, OnlyTidiesUpUnlessAskedForMore) {
  const Mesh ball = test::ballMesh(10.0, 24);
  const auto cleaned = cleanMesh(ball, {}, {});
  ASSERT_TRUE(cleaned);
  EXPECT_EQ(cleaned->mesh.triangles, ball.triangles);
  EXPECT_THAT(namesOf(cleaned->report), ElementsAre("Merge", "Small pieces", "Separate", "Orient"));
  CleanOptions none;
  none.min_component_share = 0.0;
  none.split_non_manifold = false;
  none.orient = false;
  EXPECT_THAT(namesOf(cleanMesh(ball, none, {})->report), ElementsAre("Merge"));
}

TEST(CleanMesh, KeepsTheInputAndGivesTheSameTwice) {
  const Mesh scan = roughScan();
  const Mesh before = scan;
  const auto first = cleanMesh(scan, everything(), {});
  const auto second = cleanMesh(scan, everything(), {});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(scan.triangles, before.triangles);
  ASSERT_EQ(first->mesh.triangles, second->mesh.triangles);
  for (std::size_t v = 0; v < first->mesh.vertices.size(); ++v) {
    EXPECT_EQ(first->mesh.vertices[v].position, second->mesh.vertices[v].position);
    EXPECT_EQ(first->mesh.vertices[v].rgb, second->mesh.vertices[v].rgb);
  }
}

TEST(CleanMesh, ReportsProgressUpwards) {
  double last = 0.0;
  const Task task({}, [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last - 1e-12);
    last = fraction;
  });
  ASSERT_TRUE(cleanMesh(roughScan(), everything(), task));
  EXPECT_GT(last, 0.5);
}

TEST(CleanMesh, RefusesWhatItCannotDo) {
  EXPECT_EQ(cleanMesh(Mesh{}, {}, {}).error().code, Error::Code::kTooFew);
  const Mesh ball = test::ballMesh(10.0, 24);
  CleanOptions away;
  away.crop.z_min_mm = 50.0;
  EXPECT_EQ(cleanMesh(ball, away, {}).error().code, Error::Code::kTooFew);
  CleanOptions wrong;
  wrong.min_component_share = 2.0;
  EXPECT_EQ(cleanMesh(ball, wrong, {}).error().code, Error::Code::kInvalidInput);
  Mesh broken = ball;
  broken.vertices[1].sigma_mm = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(cleanMesh(broken, {}, {}).error().code, Error::Code::kInvalidInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(cleanMesh(ball, {}, Task(stop.get_token())).error().code, Error::Code::kCancelled);
}

TEST(CleanOptions, HasAWordForEveryField) {
  CleanOptions options;
  const OptionList list = OptionList::of(options);
  std::vector<std::string> names;
  for (const Option& option : list.options()) names.push_back(option.info.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_TRUE(options.validate());
  ASSERT_TRUE(list.find("z-min")->setFromText("1.5"));
  EXPECT_EQ(options.crop.z_min_mm, 1.5);
}

// A person at the sliders: whatever was asked before, each answer is that of the options alone.
TEST(RepeatedCleanUp, GivesWhatCleaningFromTheStartGives) {
  const auto scan = std::make_shared<const Mesh>(roughScan());
  const auto other = std::make_shared<const Mesh>(test::ballMesh(10.0, 24));
  CleanOptions based;
  based.crop.z_min_mm = 0.5;
  based.base_cap = true;
  based.holes.max_width_mm = 8.0;
  CleanOptions smoothed = based;
  smoothed.smooth.iterations = 5;
  CleanOptions reduced = smoothed;
  reduced.decimate.triangles = 2000;
  CleanOptions unmerged = reduced;
  unmerged.min_component_share = 0.0;
  RepeatedCleanUp repeated;
  const std::vector<std::pair<MeshPtr, CleanOptions>> asked = {
      {scan, based},   {scan, smoothed}, {scan, reduced},  {scan, based},
      {scan, reduced}, {other, reduced}, {scan, unmerged}, {scan, CleanOptions{}}};
  for (const auto& [mesh, options] : asked) {
    const auto alone = cleanMesh(*mesh, options, {});
    const auto again = repeated.run(mesh, options, {});
    ASSERT_TRUE(alone) << alone.error().sentence();
    ASSERT_TRUE(again) << again.error().sentence();
    EXPECT_EQ(again->mesh.triangles, alone->mesh.triangles);
    EXPECT_EQ(namesOf(again->report), namesOf(alone->report));
    EXPECT_EQ(again->report.before.triangles, alone->report.before.triangles);
    EXPECT_EQ(again->report.after.volume_mm3, alone->report.after.volume_mm3);
  }
}

TEST(RepeatedCleanUp, GoesOnAfterAStopAndARefusal) {
  const auto scan = std::make_shared<const Mesh>(roughScan());
  CleanOptions options;
  options.smooth.iterations = 5;
  RepeatedCleanUp repeated;
  ASSERT_TRUE(repeated.run(scan, options, {}));
  std::stop_source stop;
  stop.request_stop();
  options.crop.z_min_mm = 2.0;
  EXPECT_EQ(repeated.run(scan, options, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
  CleanOptions nothing = options;
  nothing.crop.z_min_mm = 1000.0;
  EXPECT_EQ(repeated.run(scan, nothing, {}).error().code, Error::Code::kTooFew);
  const auto alone = cleanMesh(*scan, options, {});
  const auto again = repeated.run(scan, options, {});
  ASSERT_TRUE(alone && again);
  EXPECT_EQ(again->mesh.triangles, alone->mesh.triangles);
  EXPECT_EQ(repeated.run(std::make_shared<const Mesh>(), options, {}).error().code,
            cleanMesh(Mesh{}, options, {}).error().code);
}

}  // namespace
}  // namespace gyre
