// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/io/little_endian.h"
#include "core/io/standing_mesh.h"
#include "tests/support/foreign_model.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr double kFloat_m = 2e-9;  // a step of a float below 0.03 m

Eigen::Vector3d tableFromGltf_mm(const Eigen::Vector3d& in_gltf) {
  return 1000.0 * Eigen::Vector3d(in_gltf.x(), -in_gltf.z(), in_gltf.y());
}

// What a viewer shows: the level of sRGB for a share of light.
double shownLevel(double light) {
  return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

nlohmann::json jsonOf(const std::string& glb) {
  return nlohmann::json::parse(glb.substr(20, littleEndianAt<std::uint32_t>(&glb[12])));
}

TEST(WriteGlb, IsReadByOthersInMetresWithYUp) {
  const TempDir dir;
  ASSERT_TRUE(writeGlb(dir / "Ei ä.glb", test::hoveringEgg()));
  const test::ForeignModel foreign = test::readByAssimp(dir / "Ei ä.glb");
  const auto standing = standingMesh(test::hoveringEgg());
  ASSERT_EQ(foreign.triangles.size(), standing->triangles.size());
  EXPECT_EQ(foreign.bounds.min.y(), 0.0);
  EXPECT_NEAR(foreign.bounds.max.y(), 0.024, kFloat_m);
  EXPECT_NEAR(foreign.bounds.max.x(), 0.001 * boundsOf(*standing).max.x(), kFloat_m);
  EXPECT_NEAR(foreign.bounds.max.z(), -0.001 * boundsOf(*standing).min.y(), kFloat_m);
}

TEST(WriteGlb, KeepsTrianglesNormalsAndColours) {
  const TempDir dir;
  ASSERT_TRUE(writeGlb(dir / "a.glb", test::hoveringEgg()));
  const test::ForeignModel foreign = test::readByAssimp(dir / "a.glb");
  const auto standing = standingMesh(test::hoveringEgg());
  ASSERT_EQ(foreign.triangles.size(), standing->triangles.size());
  for (std::size_t i = 0; i < foreign.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const test::ForeignCorner& corner = foreign.triangles[i][k];
      const MeshVertex& vertex = standing->vertices[standing->triangles[i][k]];
      EXPECT_LT((tableFromGltf_mm(corner.position) - vertex.position).norm(), 1000 * kFloat_m);
      EXPECT_LT((tableFromGltf_mm(corner.normal) / 1000 - vertex.normal).norm(), 1e-6);
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(shownLevel(corner.colour[channel]),
                    vertex.rgb[static_cast<std::size_t>(channel)], 0.1);
      }
    }
  }
}

TEST(GlbBytes, TellsSmallestAndLargestAsTheValidatorWants) {
  const auto bytes = glbBytes(test::hoveringEgg());
  ASSERT_TRUE(bytes) << bytes.error().sentence();
  EXPECT_EQ(bytes->substr(0, 4), "glTF");
  EXPECT_EQ(bytes->size() % 4, 0U);
  EXPECT_EQ(littleEndianAt<std::uint32_t>(&(*bytes)[8]), bytes->size());
  const auto json = jsonOf(*bytes);
  const auto& attributes = json.at("meshes")[0].at("primitives")[0].at("attributes");
  const auto& positions = json.at("accessors")[attributes.at("POSITION").get<std::size_t>()];
  // The bounds are those of the floats in the file, to the last bit.
  const double lowest = positions.at("min")[0].get<double>();
  EXPECT_EQ(lowest, static_cast<double>(static_cast<float>(lowest)));
  EXPECT_EQ(positions.at("min")[1].get<double>(), 0.0);
  const auto& colours = json.at("accessors")[attributes.at("COLOR_0").get<std::size_t>()];
  EXPECT_TRUE(colours.at("normalized").get<bool>());
  for (const auto& view : json.at("bufferViews")) {
    EXPECT_EQ(view.value("byteOffset", 0) % 4, 0);
  }
  EXPECT_EQ(json.at("materials")[0].at("pbrMetallicRoughness").at("metallicFactor"), 0.0);
}

TEST(GlbBytes, CarriesTitleNumberAndRights) {
  const auto json = jsonOf(*glbBytes(sampleMesh(), {"Ente \"ä\" \xff", "MK 12", "CC BY 4.0"}));
  EXPECT_EQ(json.at("nodes")[0].at("name"), "Ente \"ä\" \xEF\xBF\xBD");
  EXPECT_EQ(json.at("asset").at("copyright"), "CC BY 4.0");
  EXPECT_EQ(json.at("asset").at("extras").at("inventory_number"), "MK 12");
  const auto bare = jsonOf(*glbBytes(sampleMesh()));
  EXPECT_FALSE(bare.at("asset").contains("copyright"));
  EXPECT_FALSE(bare.at("asset").contains("extras"));
}

TEST(WriteGlb, SaysWhyItCannot) {
  EXPECT_EQ(writeGlb("/nowhere/a.glb", sampleMesh()).error().code, Error::Code::kNotFound);
  EXPECT_EQ(writeGlb("/nowhere/a.glb", Mesh{}).error().code, Error::Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
