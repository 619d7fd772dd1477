// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/model_file.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(PlyBytes, BeginsWithThePublishedHeader) {
  EXPECT_THAT(plyBytes(sampleCloud()),
              StartsWith("ply\nformat binary_little_endian 1.0\n"
                         "comment Gyre: millimetres, z up along the turntable's axis\n"
                         "element vertex 3\n"
                         "property float x\nproperty float y\nproperty float z\n"
                         "property float nx\nproperty float ny\nproperty float nz\n"
                         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                         "property float sigma_mm\nproperty ushort views\n"
                         "property float cov_xx\nproperty float cov_xy\nproperty float cov_xz\n"
                         "property float cov_yy\nproperty float cov_yz\nproperty float cov_zz\n"
                         "end_header\n"));
  EXPECT_THAT(plyBytes(sampleMesh()),
              HasSubstr("property float sigma_mm\nproperty ushort views\nproperty uchar seen\n"
                        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"));
  EXPECT_THAT(plyBytes(sampleMesh(), MeshKind::kTruth),
              HasSubstr("property uchar blue\nproperty uint views_seen\nelement face 4\n"));
}

TEST(PlyBytes, HasTheSizeThatTheHeaderAnnounces) {
  const std::string cloud = plyBytes(sampleCloud());
  EXPECT_EQ(cloud.size() - (cloud.find("end_header\n") + 11), 3U * (6 * 4 + 3 + 4 + 2 + 6 * 4));
  const std::string mesh = plyBytes(sampleMesh());
  EXPECT_EQ(mesh.size() - (mesh.find("end_header\n") + 11),
            4U * (6 * 4 + 3 + 4 + 2 + 1) + 4U * (1 + 3 * 4));
}

TEST(WritePly, GivesBackEveryPointToTheLastBitOfAFloat) {
  const TempDir dir;
  const PointCloud cloud = sampleCloud();
  ASSERT_TRUE(writePly(dir / "Püñkte.ply", cloud));
  const auto back = readPointCloud(dir / "Püñkte.ply");
  ASSERT_TRUE(back) << back.error().sentence();
  ASSERT_EQ(back->points.size(), cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Point& a = cloud.points[i];
    const Point& b = back->points[i];
    EXPECT_EQ(b.position, a.position.cast<float>().cast<double>());
    EXPECT_EQ(b.normal, a.normal.cast<float>().cast<double>());
    EXPECT_EQ(b.rgb, a.rgb);
    EXPECT_EQ(b.covariance, a.covariance.cast<float>().cast<double>());
  }
}

TEST(WritePly, GivesBackTheMesh) {
  const TempDir dir;
  const Mesh mesh = sampleMesh();
  ASSERT_TRUE(writePly(dir / "mesh.ply", mesh));
  const auto back = readMesh(dir / "mesh.ply");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->triangles, mesh.triangles);
  ASSERT_EQ(back->vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(back->vertices[i].position, mesh.vertices[i].position);
    EXPECT_EQ(back->vertices[i].normal, mesh.vertices[i].normal.cast<float>().cast<double>());
    EXPECT_EQ(back->vertices[i].rgb, mesh.vertices[i].rgb);
    EXPECT_EQ(back->vertices[i].sigma_mm, mesh.vertices[i].sigma_mm);
    EXPECT_EQ(back->vertices[i].views, mesh.vertices[i].views);
    EXPECT_EQ(back->vertices[i].seen, mesh.vertices[i].seen);
  }
}

TEST(WritePly, KeepsInTheTruthHowManyViewsSawAVertex) {
  const TempDir dir;
  ASSERT_TRUE(writePly(dir / "truth.ply", sampleMesh(), MeshKind::kTruth));
  EXPECT_EQ(readMesh(dir / "truth.ply")->vertices[2].views, sampleMesh().vertices[2].views);
}

TEST(WritePly, SaysWhyItCannot) {
  EXPECT_EQ(writePly("/nowhere/points.ply", sampleCloud()).error().code, Error::Code::kNotFound);
}

}  // namespace
}  // namespace gyre
