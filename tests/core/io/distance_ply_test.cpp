// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/distance_ply.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/little_endian.h"
#include "core/io/model_file.h"
#include "tests/support/model_samples.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(DistancePly, HoldsPlacesColoursDistancesAndFaces) {
  const Mesh mesh = sampleMesh();
  const std::vector<double> distances_mm = {0.0, 0.25, 1.5, 3.0};
  const std::string bytes = distancePlyBytes(mesh, distances_mm, "viridis from 0 to 2 mm");
  EXPECT_THAT(bytes,
              HasSubstr("comment quality: distance in mm; colours: viridis from 0 to 2 mm\n"));
  const auto read = parsePly(bytes, "f");
  ASSERT_TRUE(read) << read.error().sentence();
  const auto& back = std::get<Mesh>(*read);
  ASSERT_EQ(back.vertices.size(), 4U);
  EXPECT_EQ(back.triangles, mesh.triangles);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(back.vertices[i].position, mesh.vertices[i].position.cast<float>().cast<double>());
    EXPECT_EQ(back.vertices[i].rgb, mesh.vertices[i].rgb);
    const std::size_t body = bytes.find("end_header\n") + 11;
    EXPECT_EQ(littleEndianAt<float>(bytes.data() + body + i * 19 + 15),
              static_cast<float>(distances_mm[i]));
  }
}

TEST(DistancePly, OfACloudHasNoFaces) {
  Mesh mesh = sampleMesh();
  mesh.triangles.clear();
  const std::string bytes = distancePlyBytes(mesh, std::vector<double>(4, 1.0), "a");
  EXPECT_THAT(bytes, Not(HasSubstr("element face")));
  const auto read = parsePly(bytes, "f");
  ASSERT_TRUE(read);
  EXPECT_EQ(std::get<PointCloud>(*read).points.size(), 4U);
}

}  // namespace
}  // namespace gyre
