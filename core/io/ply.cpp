// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ply.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "core/io/atomic_file.h"
#include "core/io/little_endian.h"

namespace gyre {
namespace {

constexpr std::string_view kVertexProperties =
    "property float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";
constexpr std::string_view kMeasureProperties = "property float sigma_mm\nproperty ushort views\n";

std::string headerFor(std::size_t vertices) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\n"
      "comment Gyre: millimetres, z up along the turntable's axis\nelement vertex ";
  return text.append(std::to_string(vertices)).append("\n").append(kVertexProperties);
}

void appendVector(std::string& bytes, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, static_cast<float>(vector[i]));
}

// What points and mesh vertices begin with.
template <class Vertex>
void appendCommon(std::string& bytes, const Vertex& vertex) {
  appendVector(bytes, vertex.position);
  appendVector(bytes, vertex.normal);
  for (const std::uint8_t channel : vertex.rgb) appendLittleEndian(bytes, channel);
}

std::uint16_t viewCount(const Point& point) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(point.views.size(), kMost));
}

}  // namespace

std::string plyBytes(const PointCloud& cloud) {
  std::string bytes = headerFor(cloud.points.size());
  bytes.append(kMeasureProperties)
      .append("property float cov_xx\nproperty float cov_xy\nproperty float cov_xz\n")
      .append("property float cov_yy\nproperty float cov_yz\nproperty float cov_zz\n")
      .append("end_header\n");
  for (const Point& point : cloud.points) {
    appendCommon(bytes, point);
    appendLittleEndian(bytes, static_cast<float>(point.sigmaMm()));
    appendLittleEndian(bytes, viewCount(point));
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) {
        appendLittleEndian(bytes, static_cast<float>(point.covariance(row, column)));
      }
    }
  }
  return bytes;
}

std::string plyBytes(const Mesh& mesh, MeshKind kind) {
  const bool truth = kind == MeshKind::kTruth;
  std::string bytes = headerFor(mesh.vertices.size());
  bytes.append(truth ? "property uint views_seen\n" : kMeasureProperties)
      .append(truth ? "" : "property uchar seen\n")
      .append("element face ")
      .append(std::to_string(mesh.triangles.size()))
      .append("\nproperty list uchar int vertex_indices\nend_header\n");
  for (const MeshVertex& vertex : mesh.vertices) {
    appendCommon(bytes, vertex);
    if (truth) {
      appendLittleEndian(bytes, std::uint32_t{vertex.views});
    } else {
      appendLittleEndian(bytes, vertex.sigma_mm);
      appendLittleEndian(bytes, vertex.views);
      appendLittleEndian(bytes, vertex.seen);
    }
  }
  for (const Triangle& triangle : mesh.triangles) {
    appendLittleEndian(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : triangle) appendLittleEndian(bytes, corner);
  }
  return bytes;
}

Result<void> writePly(const std::filesystem::path& file, const PointCloud& cloud) {
  return writeFileAtomically(file, plyBytes(cloud));
}

Result<void> writePly(const std::filesystem::path& file, const Mesh& mesh, MeshKind kind) {
  return writeFileAtomically(file, plyBytes(mesh, kind));
}

}  // namespace gyre
