// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/merge/pass_input.h"

#include <string>
#include <utility>
#include <variant>

#include "core/io/file_bytes.h"
#include "core/io/model_file.h"
#include "core/io/passes_file.h"
#include "core/io/report_reader.h"
#include "core/io/silhouettes_file.h"
#include "core/io/visibility_file.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

Result<void> complete(const fs::path& folder) {
  if (isThere(folder / kPassesFile)) {
    return Error{Error::Code::kInvalidInput, "\"" + folder.string() + "\" is itself merged.",
                 "Name the passes that it was merged from, and the new one, all at once."};
  }
  for (const char* name : {"points.ply", "mesh.ply", "visibility.bin", "calibration.json",
                           "angles_solved.csv", "report.json"}) {
    if (isThere(folder / name)) continue;
    return Error{Error::Code::kNotFound,
                 "There is no " + std::string(name) + " in \"" + folder.string() + "\".",
                 "Name the folders of finished scans or reconstructions; `gyre resume` finishes a "
                 "scan."};
  }
  return {};
}

Result<Mesh> readSurface(const fs::path& file) {
  auto model = readMeshOrCloud(file);
  if (!model) return model.error();
  auto* mesh = std::get_if<Mesh>(&*model);
  if (mesh != nullptr && !mesh->triangles.empty()) return std::move(*mesh);
  return Error{Error::Code::kInvalidInput, "\"" + file.string() + "\" holds no surface.",
               "Make one with `gyre mesh`, written to mesh.ply beside the points."};
}

}  // namespace

Result<PassInput> readPass(const fs::path& result) {
  PassInput pass;
  pass.folder = fs::absolute(result).lexically_normal();
  if (pass.folder.extension() == ".gyre") pass.folder = pass.folder.parent_path();
  const fs::path& folder = pass.folder;
  if (const auto whole = complete(folder); !whole) return whole.error();
  auto report = readReport(folder / "report.json");
  if (!report) return report.error();
  pass.report = std::move(*report);
  if (!pass.report.size_known) {
    return Error{Error::Code::kInvalidInput,
                 "Nothing tells the size of \"" + folder.string() + "\".",
                 "Passes are laid on each other in millimetres: reconstruct it again with a "
                 "calibration, or with --known-length."};
  }
  auto views = readResultViews(folder);
  if (!views) return views.error();
  pass.views = std::move(*views);
  auto cloud = readPointCloud(folder / "points.ply");
  if (!cloud) return cloud.error();
  pass.cloud = std::move(*cloud);
  const auto visible = readVisibility(folder / "visibility.bin", pass.cloud);
  if (!visible) return visible.error();
  auto mesh = readSurface(folder / "mesh.ply");
  if (!mesh) return mesh.error();
  pass.mesh = std::move(*mesh);
  if (const fs::path file = folder / "sightings.bin"; isThere(file)) {
    auto sightings = readSightings(file, pass.cloud.points.size());
    if (!sightings) return sightings.error();
    pass.sightings = std::move(*sightings);
  }
  if (const fs::path file = folder / "silhouettes.bin"; isThere(file)) {
    auto silhouettes = readSilhouettes(file);
    if (!silhouettes) return silhouettes.error();
    pass.silhouettes = std::move(*silhouettes);
  }
  return pass;
}

}  // namespace gyre
