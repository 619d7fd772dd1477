// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_builder.h"

#include <gtest/gtest.h>

#include <limits>

namespace gyre {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ModelBuilder withVertices(int count) {
  ModelBuilder builder;
  builder.vertices.resize(static_cast<std::size_t>(count));
  return builder;
}

TEST(ModelBuilder, CutsAPolygonIntoAFan) {
  ModelBuilder builder = withVertices(5);
  builder.addFace(std::vector<std::uint32_t>{4, 3, 2, 1, 0});
  const auto outcome = builder.finish();
  ASSERT_FALSE(outcome.problem);
  EXPECT_EQ(std::get<Mesh>(outcome.model).triangles,
            (std::vector<Triangle>{{4, 3, 2}, {4, 2, 1}, {4, 1, 0}}));
}

TEST(ModelBuilder, MakesACloudWhenNoFaceHasASurface) {
  ModelBuilder builder = withVertices(3);
  builder.addFace({});
  builder.addFace(std::vector<std::uint32_t>{0, 1});
  EXPECT_FALSE(builder.hasFaces());
  EXPECT_EQ(std::get<PointCloud>(builder.finish().model).points.size(), 3U);
}

TEST(ModelBuilder, RefusesNothingAndWhatIsNowhere) {
  EXPECT_TRUE(ModelBuilder().finish().problem);
  ModelBuilder builder = withVertices(1);
  builder.vertices[0].vertex.position.y() = kNan;
  EXPECT_TRUE(builder.finish().problem);
  builder = withVertices(2);
  builder.addFace(std::vector<std::uint32_t>{0, 1, 2});
  EXPECT_TRUE(builder.finish().problem);
}

TEST(ModelBuilder, GivesNormalsUnitLengthAndForgetsThoseThatAreNone) {
  ModelBuilder builder = withVertices(3);
  builder.vertices[0].vertex.normal = {0, 0, 5};
  builder.vertices[1].vertex.normal = {0, kNan, 5};
  builder.vertices[2].vertex.normal = {0, 0, 1.00001};  // as near as a float comes: left alone
  builder.vertices[2].vertex.sigma_mm = -1.0F;
  const auto outcome = builder.finish();
  const auto& points = std::get<PointCloud>(outcome.model).points;
  EXPECT_EQ(points[0].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(points[1].normal, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(points[2].normal.z(), 1.00001);
  EXPECT_EQ(points[2].sigmaMm(), 0.0);
}

}  // namespace
}  // namespace gyre
