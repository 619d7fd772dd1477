// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/mesh_input.h"

#include <system_error>
#include <utility>

#include "core/io/file_bytes.h"
#include "core/io/model_file.h"
#include "core/io/visibility_file.h"
#include "core/pipeline/sights.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

// points.ply of a folder or a scan, or the file itself.
fs::path pointsFile(const std::string& input) {
  fs::path file = input;
  std::error_code ignored;
  if (file.extension() == ".gyre") file = file.parent_path() / "points.ply";
  if (fs::is_directory(file, ignored)) file /= "points.ply";
  return file;
}

Result<PointCloud> readPoints(const fs::path& file) {
  if (!isThere(file)) {
    return Error{Error::Code::kNotFound, "There is no \"" + file.string() + "\".",
                 "Name the folder of a reconstruction, a scan, or a file of points."};
  }
  auto cloud = readPointCloud(file);
  if (!cloud) return cloud;
  const fs::path visibility = file.parent_path() / "visibility.bin";
  if (file.filename() == "points.ply" && isThere(visibility)) {
    if (const auto read = readVisibility(visibility, *cloud); !read) return read.error();
  }
  return cloud;
}

}  // namespace

Result<MeshInput> readMeshInput(const std::string& input, MeshMethod method) {
  const fs::path file = pointsFile(input);
  MeshInput read;
  read.folder = file.parent_path();
  auto cloud = readPoints(file);
  if (cloud) {
    read.cloud = std::move(*cloud);
  } else if (method != MeshMethod::kSilhouette || !isThere(read.folder / "silhouettes.bin")) {
    return cloud.error();
  }
  // A cloud of another program may lie beside a scan's files.
  if (file.filename() != "points.ply") return read;
  if (method != MeshMethod::kSilhouette && !isThere(read.folder / "visibility.bin")) return read;
  auto sights = readSights(read.folder, read.cloud);
  if (!sights) return sights.error();
  read.sights = std::move(*sights);
  return read;
}

}  // namespace gyre
