// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/distance_ply.h"

#include "core/base/check.h"
#include "core/io/little_endian.h"

namespace gyre {

std::string distancePlyBytes(const Mesh& mesh, std::span<const double> distances_mm,
                             const std::string& scale) {
  GYRE_CHECK(distances_mm.size() == mesh.vertices.size());
  GYRE_CHECK(scale.find('\n') == std::string::npos);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment Gyre: millimetres\n";
  bytes += "comment quality: distance in mm; colours: " + scale + "\n";
  bytes += "element vertex " + std::to_string(mesh.vertices.size()) + "\n";
  bytes += "property float x\nproperty float y\nproperty float z\n";
  bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes += "property float quality\n";
  if (!mesh.triangles.empty()) {
    bytes += "element face " + std::to_string(mesh.triangles.size()) +
             "\nproperty list uchar int vertex_indices\n";
  }
  bytes += "end_header\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const MeshVertex& vertex = mesh.vertices[i];
    for (int k = 0; k < 3; ++k) appendLittleEndian(bytes, static_cast<float>(vertex.position[k]));
    for (const std::uint8_t channel : vertex.rgb) appendLittleEndian(bytes, channel);
    appendLittleEndian(bytes, static_cast<float>(distances_mm[i]));
  }
  for (const Triangle& triangle : mesh.triangles) {
    appendLittleEndian(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : triangle) appendLittleEndian(bytes, corner);
  }
  return bytes;
}

}  // namespace gyre
