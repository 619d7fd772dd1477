// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/io/model_writer.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

// What Open3D reads in these files. Debian's own Python, for the module is installed there.
std::vector<nlohmann::json> readByOpen3d(const TempDir& dir,
                                         const std::vector<std::string>& names) {
  std::string command = "/usr/bin/python3 " GYRE_OPEN3D_BOXES;
  for (const std::string& name : names) command += " '" + (dir / name).string() + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> some{};
  while (pipe != nullptr) {
    const std::size_t count = std::fread(some.data(), 1, some.size(), pipe.get());
    if (count == 0) break;
    text.append(some.data(), count);
  }
  std::vector<nlohmann::json> answers;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    if (line.starts_with('{')) answers.push_back(nlohmann::json::parse(line));
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return answers;
}

// A wedge of 20 x 30 x 10 mm that stands on the platter away from the axis, a colour a corner.
Mesh wedge() {
  Mesh mesh = sampleMesh();
  mesh.vertices[0].position = {5.0, -40.0, 0.0};
  mesh.vertices[1].position = {25.0, -40.0, 0.0};
  mesh.vertices[2].position = {5.0, -10.0, 0.0};
  mesh.vertices[3].position = {5.0, -40.0, 10.0};
  computeNormals(mesh);
  return mesh;
}

void expectNear(const nlohmann::json& place, const Eigen::Vector3d& truth,
                const std::string& name) {
  ASSERT_EQ(place.size(), 3U) << name;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(place[static_cast<std::size_t>(i)].get<double>(), truth[i],
                1e-5 * truth.cwiseAbs().maxCoeff())
        << name;
  }
}

TEST(Open3d, ReadsOurModelsAtTheirSizeAndPlaceClosedAndOutwards) {
  const TempDir dir;
  const std::vector<std::string> names = {"a.ply", "a.obj", "a.stl"};
  for (const std::string& name : names) ASSERT_TRUE(writeModel(dir / name, wedge()));
  const auto read = readByOpen3d(dir, names);
  ASSERT_EQ(read.size(), names.size()) << "is python3-open3d installed?";
  for (std::size_t i = 0; i < names.size(); ++i) {
    expectNear(read[i]["min"], {5.0, -40.0, 0.0}, names[i]);
    expectNear(read[i]["max"], {25.0, -10.0, 10.0}, names[i]);
    EXPECT_EQ(read[i]["triangles"], 4) << names[i];
    EXPECT_EQ(read[i]["watertight"], true) << names[i];
    EXPECT_NEAR(read[i]["volume"].get<double>(), 20.0 * 30.0 * 10.0 / 6.0, 1e-2) << names[i];
  }
}

TEST(Open3d, ReadsGlbInMetresWithYUp) {
  const TempDir dir;
  ASSERT_TRUE(writeModel(dir / "a.glb", wedge()));
  const auto read = readByOpen3d(dir, {"a.glb"});
  ASSERT_EQ(read.size(), 1U) << "is python3-open3d installed?";
  expectNear(read[0]["min"], {0.005, 0.0, 0.010}, "a.glb");
  expectNear(read[0]["max"], {0.025, 0.010, 0.040}, "a.glb");
  EXPECT_EQ(read[0]["triangles"], 4);
}

TEST(Open3d, ReadsTheColoursOfPlyAndObj) {
  const TempDir dir;
  const Mesh mesh = wedge();
  for (const char* name : {"a.ply", "a.obj"}) ASSERT_TRUE(writeModel(dir / name, mesh));
  const auto read = readByOpen3d(dir, {"a.ply", "a.obj"});
  ASSERT_EQ(read.size(), 2U) << "is python3-open3d installed?";
  nlohmann::json colours = nlohmann::json::array();
  for (const MeshVertex& vertex : mesh.vertices) colours.push_back(vertex.rgb);
  for (const auto& file : read) EXPECT_EQ(file["colours"], colours);
}

}  // namespace
}  // namespace gyre
