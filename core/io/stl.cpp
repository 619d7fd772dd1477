// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/stl.h"

#include <string_view>

#include <Eigen/Geometry>

#include "core/io/atomic_file.h"
#include "core/io/little_endian.h"
#include "core/io/standing_mesh.h"

namespace gyre {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;
// A reader takes a file that begins with "solid" for text.
constexpr std::string_view kHeader = "Gyre: millimetres, z up, standing on z = 0";

void appendVector(std::string& bytes, const Eigen::Vector3f& vector) {
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, vector[i]);
}

}  // namespace

Result<std::string> stlBytes(const Mesh& mesh) {
  const auto standing = standingMesh(mesh);
  if (!standing) return standing.error();
  std::string bytes(kHeader);
  bytes.reserve(kHeaderBytes + 4 + kTriangleBytes * standing->triangles.size());
  bytes.resize(kHeaderBytes, '\0');
  appendLittleEndian(bytes, static_cast<std::uint32_t>(standing->triangles.size()));
  for (const Triangle& triangle : standing->triangles) {
    const Eigen::Vector3d& a = standing->vertices[triangle[0]].position;
    const Eigen::Vector3d& b = standing->vertices[triangle[1]].position;
    const Eigen::Vector3d& c = standing->vertices[triangle[2]].position;
    // A triangle without area keeps a zero normal, as the format's readers expect.
    appendVector(bytes, (b - a).cross(c - a).normalized().cast<float>());
    for (const Eigen::Vector3d& corner : {a, b, c}) appendVector(bytes, corner.cast<float>());
    appendLittleEndian(bytes, std::uint16_t{0});
  }
  return bytes;
}

Result<void> writeStl(const std::filesystem::path& file, const Mesh& mesh) {
  const auto bytes = stlBytes(mesh);
  if (!bytes) return bytes.error();
  return writeFileAtomically(file, *bytes);
}

}  // namespace gyre
