// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/objects.h"

#include <map>
#include <memory>
#include <numeric>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/sim/object_models.h"

namespace gyre {
namespace {

class EveryObject : public testing::TestWithParam<std::string> {
 protected:
  RigSettings rig() const {
    RigSettings rig;
    rig.object = GetParam();
    return rig;
  }

  // Built once for all tests of one object.
  const SimObject& object() const {
    static std::map<std::string, std::unique_ptr<SimObject>> built;
    auto& mine = built[GetParam()];
    if (!mine) mine = std::make_unique<SimObject>(rig());
    return *mine;
  }
};

TEST_P(EveryObject, IsClosedManifoldAndOrientedOutward) {
  const Mesh& mesh = object().mesh();
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  double six_volumes = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++directed[{triangle[i], triangle[(i + 1) % 3]}];
    six_volumes += mesh.vertices[triangle[0]].position.dot(
        mesh.vertices[triangle[1]].position.cross(mesh.vertices[triangle[2]].position));
  }
  // Every edge is walked once each way: closed, oriented, and no edge has more than two faces.
  int faults = 0;
  for (const auto& [edge, count] : directed) {
    const auto twin = directed.find({edge.second, edge.first});
    if (count != 1 || twin == directed.end()) ++faults;
  }
  EXPECT_EQ(faults, 0);
  EXPECT_GT(six_volumes, 0.0);
}

TEST_P(EveryObject, IsOnePiece) {
  const Mesh& mesh = object().mesh();
  std::vector<std::size_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) pieces += root(i) == i ? 1 : 0;
  EXPECT_EQ(pieces, 1U);
}

TEST_P(EveryObject, StandsOnThePlatterAtItsSizeAndPlace) {
  const Mesh& mesh = object().mesh();
  const Bounds bounds = boundsOf(mesh);
  EXPECT_NEAR(bounds.diagonal(), 80.0, 1e-6);
  EXPECT_NEAR(bounds.min.z(), 0.0, 1e-9);
  const Eigen::Vector3d middle = 0.5 * (bounds.min + bounds.max);
  EXPECT_NEAR((middle.head<2>() - objectOffsetInTable(rig())).norm(), 0.0, 1e-6);
  // It stands: a fair part of it touches the platter.
  int touching = 0;
  for (const MeshVertex& vertex : mesh.vertices) {
    touching += vertex.position.z() < 0.1 ? 1 : 0;
  }
  EXPECT_GT(touching, 200);
}

TEST_P(EveryObject, HasEdgesOfHalfAMillimetre) {
  const Mesh& mesh = object().mesh();
  double sum = 0.0;
  double longest = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double length = (mesh.vertices[a].position - mesh.vertices[b].position).norm();
    sum += length;
    longest = std::max(longest, length);
  }
  EXPECT_LT(sum / static_cast<double>(mesh.triangles.size()), 0.6);
  EXPECT_LT(longest, 1.3);
}

INSTANTIATE_TEST_SUITE_P(Objects, EveryObject, testing::ValuesIn(objectNames()),
                         [](const auto& object) { return object.param; });

double contrastOf(const std::string& name) {
  RigSettings rig;
  rig.object = name;
  const SimObject object(rig);
  double sum = 0.0;
  double squares = 0.0;
  for (const MeshVertex& vertex : object.mesh().vertices) {
    sum += vertex.rgb[1];
    squares += static_cast<double>(vertex.rgb[1]) * vertex.rgb[1];
  }
  const auto n = static_cast<double>(object.mesh().vertices.size());
  return std::sqrt(squares / n - (sum / n) * (sum / n));
}

TEST(Objects, OnlyThePlainOneHasAlmostNoTexture) {
  EXPECT_LT(contrastOf("plain"), 2.0);
  EXPECT_GT(contrastOf("duck"), 25.0);
}

TEST(Objects, AreTheSameEachTime) {
  const SimObject first{RigSettings{}};
  const SimObject second{RigSettings{}};
  ASSERT_EQ(first.mesh().vertices.size(), second.mesh().vertices.size());
  EXPECT_EQ(first.mesh().triangles, second.mesh().triangles);
  for (std::size_t i = 0; i < first.mesh().vertices.size(); ++i) {
    ASSERT_EQ(first.mesh().vertices[i].position, second.mesh().vertices[i].position);
    ASSERT_EQ(first.mesh().vertices[i].rgb, second.mesh().vertices[i].rgb);
  }
}

TEST(Objects, AreTheSameObjectHoweverTheyLie) {
  RigSettings rig;
  const SimObject upright(rig);
  rig.object_roll_deg = 180.0;
  rig.object_yaw_deg = 35.0;
  const SimObject turned(rig);
  ASSERT_EQ(turned.mesh().vertices.size(), upright.mesh().vertices.size());
  const Bounds bounds = boundsOf(turned.mesh());
  EXPECT_NEAR(bounds.min.z(), 0.0, 1e-9);
  EXPECT_NEAR((0.5 * (bounds.min + bounds.max).head<2>() - objectOffsetInTable(rig)).norm(), 0.0,
              1e-9);
  for (std::size_t i = 0; i < upright.mesh().vertices.size(); i += 97) {
    const MeshVertex& was = upright.mesh().vertices[i];
    const MeshVertex& is = turned.mesh().vertices[i];
    EXPECT_LT((turned.uprightFromTable() * is.position - was.position).norm(), 1e-9);
    EXPECT_LT((turned.uprightFromTable().rotation * is.normal - was.normal).norm(), 1e-9);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const Eigen::Vector3f paint = turned.paintAt(is.position);
      EXPECT_NEAR(turned.albedo(paint, is.position.cast<float>())[static_cast<int>(channel)],
                  static_cast<float>(was.rgb[channel]) / 255.0F, 0.004F);
    }
  }
}

TEST(Objects, CubeIsACube) {
  RigSettings rig;
  rig.object = "cube";
  const Bounds bounds = boundsOf(SimObject(rig).mesh());
  const Eigen::Vector3d side = bounds.max - bounds.min;
  EXPECT_NEAR((side - Eigen::Vector3d::Constant(80.0 / std::sqrt(3.0))).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace gyre
