// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/compare.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/surfaces.h"

namespace gyre {
namespace {

using ::testing::HasSubstr;

CompareOptions quick() {
  CompareOptions options;
  options.samples = 20000;
  return options;
}

TEST(CompareSurfaces, IsExactForParallelPlanes) {
  const auto comparison =
      compareSurfaces(test::squareMesh(20.0, 0.4), test::squareMesh(20.0, 0.0), quick(), {});
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->mean_mm, 0.4, 1e-12);
  EXPECT_NEAR(comparison->median_mm, 0.4, 1e-12);
  EXPECT_NEAR(comparison->p95_mm, 0.4, 1e-12);
  EXPECT_EQ(comparison->samples, 20000U);
  ASSERT_EQ(comparison->at.size(), 3U);
  EXPECT_EQ(comparison->at[0].precision, 0.0);
  EXPECT_EQ(comparison->at[0].f, 0.0);
  EXPECT_EQ(comparison->at[1].precision, 1.0);
  EXPECT_EQ(comparison->at[1].completeness, 1.0);
  EXPECT_EQ(comparison->at[1].f, 1.0);
}

TEST(CompareSurfaces, MeasuresSpheresOneInsideTheOther) {
  const auto comparison =
      compareSurfaces(test::sphereMesh(10.3), test::sphereMesh(10.0), quick(), {});
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->mean_mm, 0.3, 0.004);  // the reference's facets lie up to 3.4 um inside
}

TEST(CompareSurfaces, CountsAPartAsPartOfTheWhole) {
  const auto comparison =
      compareSurfaces(test::squareMesh(10.0, 0.0), test::squareMesh(20.0, 0.0), quick(), {});
  ASSERT_TRUE(comparison);
  const ComparisonAt& at = comparison->at[0];
  EXPECT_EQ(at.precision, 1.0);
  // A quarter, and a rim a quarter of a millimetre wide with rounded corners.
  const double expected = (100.0 + 4 * 10.0 * 0.25 + kPi * 0.0625) / 400.0;
  EXPECT_NEAR(at.completeness, expected, 0.005);
  EXPECT_NEAR(at.f, 2.0 * at.completeness / (1.0 + at.completeness), 1e-12);
}

TEST(CompareSurfaces, TakesCloudsAsTheyAre) {
  PointCloud cloud;
  for (const double height_mm : {0.1, 0.2, 0.6}) {
    cloud.points.push_back(test::surfacePoint({0, 0, height_mm}, {0, 0, 1}));
  }
  const auto comparison =
      compareSurfaces(meshOfPoints(cloud), test::squareMesh(4.0, 0.0), quick(), {});
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->samples, 3U);
  EXPECT_NEAR(comparison->mean_mm, 0.3, 1e-12);
  EXPECT_NEAR(comparison->at[0].precision, 2.0 / 3.0, 1e-12);
}

TEST(CompareSurfaces, JudgesSeenSurfaceAboveThePlatterOnly) {
  Mesh truth = test::joined(test::squareMesh(20.0, 5.0), test::squareMesh(20.0, 50.0));
  for (MeshVertex& vertex : truth.vertices) vertex.views = vertex.position.z() < 10.0 ? 9 : 4;
  const Mesh result =
      test::joined(test::joined(test::squareMesh(20.0, 5.2),    // near seen surface
                                test::squareMesh(20.0, 48.0)),  // near unseen surface
                   test::squareMesh(20.0, 0.1));                // on the platter
  const CompareOptions options = judgingOptions(truth);
  EXPECT_NEAR(options.min_height_mm, 0.01 * std::sqrt(400.0 + 400.0 + 2025.0), 1e-9);
  const auto comparison = compareSurfaces(result, truth, options, {});
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->p95_mm, 0.2, 1e-9);
  EXPECT_NEAR(static_cast<double>(comparison->samples), 33333.0, 3.0);
  EXPECT_EQ(comparison->at[0].completeness, 1.0);
}

TEST(CompareSurfaces, AlignsWhenAsked) {
  Mesh egg = test::gridMesh(61, 61, [](double u, double v) {
    return Eigen::Vector3d(20 * u, 30 * v, 6 * std::sin(5 * u) * std::cos(4 * v));
  });
  Mesh moved = egg;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.08, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (MeshVertex& vertex : moved.vertices) {
    vertex.position = turn * vertex.position + Eigen::Vector3d(0.5, -0.4, 0.3);
  }
  CompareOptions options = quick();
  EXPECT_GT(compareSurfaces(moved, egg, options, {})->median_mm, 0.1);
  options.alignment = Alignment::kRigid;
  const auto aligned = compareSurfaces(moved, egg, options, {});
  ASSERT_TRUE(aligned);
  EXPECT_LT(aligned->p95_mm, 0.002);
}

TEST(CompareSurfaces, TellsHowItMovedTheResult) {
  const Mesh bent = test::gridMesh(61, 61, [](double u, double v) {
    return Eigen::Vector3d(20 * u, 30 * v, 6 * std::sin(5 * u) * std::cos(4 * v));
  });
  Mesh moved = bent;
  for (MeshVertex& vertex : moved.vertices) vertex.position += Eigen::Vector3d(0.5, -0.4, 0.3);
  CompareOptions options = quick();
  EXPECT_TRUE(
      compareSurfaces(moved, bent, options, {})->reference_from_result.translation.isZero());
  options.alignment = Alignment::kRigid;
  const Rigid3 back = compareSurfaces(moved, bent, options, {})->reference_from_result;
  EXPECT_LT((back.translation - Eigen::Vector3d(-0.5, 0.4, -0.3)).norm(), 0.01);
}

TEST(CompareSurfaces, CountsDistancesInBins) {
  const Mesh flat = test::squareMesh(20.0, 0.0);
  PointCloud cloud;
  for (int i = 0; i < 995; ++i) {
    cloud.points.push_back(test::surfacePoint({0, 0, 0.3 * (i % 2)}, {0, 0, 1}));
  }
  for (int i = 0; i < 5; ++i) cloud.points.push_back(test::surfacePoint({0, 0, 4.0}, {0, 0, 1}));
  const auto comparison = compareSurfaces(meshOfPoints(cloud), flat, quick(), {});
  ASSERT_TRUE(comparison);
  EXPECT_DOUBLE_EQ(comparison->scale_mm, 0.5);
  EXPECT_DOUBLE_EQ(comparison->max_mm, 4.0);
  ASSERT_EQ(comparison->histogram.size(), 41U);
  double all = 0.0;
  for (const ComparisonBin& bin : comparison->histogram) {
    all += bin.share;
    if (bin.from_mm < 0.3 && bin.to_mm > 0.3 - 1e-9) {
      EXPECT_NEAR(bin.share, 0.497, 1e-9);
    }
  }
  EXPECT_NEAR(all, 1.0, 1e-12);
  EXPECT_NEAR(comparison->histogram.front().share, 0.498, 1e-9);
  EXPECT_NEAR(comparison->histogram.back().share, 0.005, 1e-9);
  EXPECT_DOUBLE_EQ(comparison->histogram.back().from_mm, 0.5);
  CompareOptions chosen = quick();
  chosen.scale_mm = 0.2;
  const auto cut = compareSurfaces(meshOfPoints(cloud), flat, chosen, {});
  EXPECT_DOUBLE_EQ(cut->scale_mm, 0.2);
  EXPECT_NEAR(cut->histogram.back().share, 0.502, 1e-9);
  chosen.scale_mm = -1.0;
  EXPECT_FALSE(compareSurfaces(flat, flat, chosen, {}));
  // All on the surface: a scale of its own, and no division by zero.
  const auto same = compareSurfaces(flat, flat, quick(), {});
  ASSERT_TRUE(same);
  EXPECT_GT(same->scale_mm, 0.0);
  EXPECT_NEAR(same->histogram.front().share, 1.0, 1e-12);
}

TEST(VertexDistances, AreThoseToTheSurface) {
  const auto distances_mm =
      vertexDistances(test::squareMesh(10.0, 0.7), test::squareMesh(20.0, 0.0), {});
  ASSERT_TRUE(distances_mm);
  EXPECT_EQ(distances_mm->size(), 121U);
  for (const double mm : *distances_mm) EXPECT_NEAR(mm, 0.7, 1e-12);
}

TEST(UnitDoubt, NamesTheUnitOfTheOtherShape) {
  const Mesh mm = test::sphereMesh(40.0);
  const auto doubt = [&](double times) {
    Mesh other = mm;
    for (MeshVertex& vertex : other.vertices) vertex.position *= times;
    return unitDoubt(mm, other);
  };
  ASSERT_TRUE(doubt(0.001));
  EXPECT_TRUE(doubt(0.001)->certain);
  EXPECT_THAT(doubt(0.001)->words.what, HasSubstr("1000 times as large as the reference"));
  EXPECT_THAT(doubt(0.001)->words.what, HasSubstr("in metres"));
  EXPECT_THAT(doubt(1000.0)->words.what, HasSubstr("as large as the result"));
  EXPECT_THAT(doubt(0.1)->words.what, HasSubstr("in centimetres"));
  EXPECT_FALSE(doubt(0.1)->certain);
  EXPECT_THAT(doubt(1.0 / 25.4)->words.what, HasSubstr("in inches"));
  EXPECT_THAT(doubt(0.0001)->words.what, HasSubstr("cannot both be in millimetres"));
  EXPECT_FALSE(doubt(1.0));
  EXPECT_FALSE(doubt(0.15));
  EXPECT_FALSE(unitDoubt(mm, Mesh{}));
}

TEST(CompareSurfaces, GivesTheSameNumbersAgain) {
  const Mesh a = test::sphereMesh(10.0, {0.1, 0, 0});
  const Mesh b = test::sphereMesh(10.0);
  const CompareOptions options = quick();
  EXPECT_EQ(compareSurfaces(a, b, options, {})->mean_mm,
            compareSurfaces(a, b, options, {})->mean_mm);
}

TEST(CompareSurfaces, SaysWhatIsWrongWithTheInput) {
  const Mesh good = test::squareMesh(10.0, 0.0);
  EXPECT_THAT(compareSurfaces(Mesh{}, good, {}, {}).error().what, HasSubstr("result holds no"));
  EXPECT_THAT(compareSurfaces(good, Mesh{}, {}, {}).error().what, HasSubstr("reference holds no"));

  Mesh not_finite = good;
  not_finite.vertices[3].position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(compareSurfaces(good, not_finite, {}, {}).error().what, HasSubstr("not a number"));

  Mesh wild = good;
  wild.triangles[0][1] = 5000;
  EXPECT_THAT(compareSurfaces(wild, good, {}, {}).error().what, HasSubstr("does not exist"));

  CompareOptions options;
  options.at_mm = {0.5, -1.0};
  EXPECT_FALSE(compareSurfaces(good, good, options, {}));
  options = {};
  options.min_views_seen = 3;  // of a reference that nothing saw
  EXPECT_EQ(compareSurfaces(good, good, options, {}).error().code, Error::Code::kTooFew);
}

TEST(CompareSurfaces, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const Mesh mesh = test::squareMesh(10.0, 0.0);
  EXPECT_EQ(compareSurfaces(mesh, mesh, {}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
