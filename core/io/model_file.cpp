// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_file.h"

#include <utility>

#include "core/io/file_bytes.h"
#include "core/io/model_format.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30U;

}  // namespace

Result<Model> readMeshOrCloud(const std::filesystem::path& file) {
  if (!isReadableModel(file)) {
    return Error{Error::Code::kInvalidInput,
                 "The file \"" + file.string() + "\" does not end in .ply, .obj or .stl.",
                 "Export the model as PLY, OBJ or STL."};
  }
  const auto bytes = readFileBytes(file, kMaxBytes);
  if (!bytes) return bytes.error();
  const auto format = modelFormatOf(file);
  if (format == ModelFormat::kPly) return parsePly(*bytes, file.string());
  if (format == ModelFormat::kObj) return parseObj(*bytes, file.string());
  return parseStl(*bytes, file.string());
}

bool isReadableModel(const std::filesystem::path& file) {
  const auto format = modelFormatOf(file);
  return format == ModelFormat::kPly || format == ModelFormat::kObj || format == ModelFormat::kStl;
}

Result<Mesh> readMesh(const std::filesystem::path& file) {
  auto model = readMeshOrCloud(file);
  if (!model) return model.error();
  if (Mesh* mesh = std::get_if<Mesh>(&*model)) return std::move(*mesh);
  return Error{Error::Code::kInvalidInput,
               "The file \"" + file.string() + "\" holds points but no surface.",
               "Make a mesh of the points first, or give a file with faces."};
}

Result<PointCloud> readPointCloud(const std::filesystem::path& file) {
  auto model = readMeshOrCloud(file);
  if (!model) return model.error();
  if (PointCloud* cloud = std::get_if<PointCloud>(&*model)) return std::move(*cloud);
  PointCloud cloud;
  for (const MeshVertex& vertex : std::get<Mesh>(*model).vertices) {
    Point point;
    point.position = vertex.position;
    point.normal = vertex.normal;
    point.rgb = vertex.rgb;
    point.covariance.diagonal().setConstant(vertex.sigma_mm * vertex.sigma_mm / 3.0);
    cloud.points.push_back(std::move(point));
  }
  return cloud;
}

}  // namespace gyre
