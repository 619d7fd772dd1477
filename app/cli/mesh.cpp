// gyre mesh: a surface through points that were measured before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/clean_words.h"
#include "app/cli/mesh_ending.h"
#include "app/cli/option_words.h"
#include "app/cli/subcommands.h"
#include "core/io/model_file.h"
#include "core/io/model_label.h"
#include "core/io/model_writer.h"
#include "core/io/visibility_file.h"
#include "core/mesh/clean/clean_mesh.h"
#include "core/pipeline/make_mesh.h"
#include "core/pipeline/report_page.h"
#include "core/pipeline/sights.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

struct Words {
  std::string input;
  std::string method = "auto";
  double alpha_mm = 0.0;
  VisibilityCutOptions cut;
  CleanOptions clean;
  std::string out;
};

// points.ply of a folder or a scan, or the file itself.
fs::path pointsFile(const std::string& input) {
  fs::path file = input;
  std::error_code ignored;
  if (file.extension() == ".gyre") file = file.parent_path() / "points.ply";
  if (fs::is_directory(file, ignored)) file /= "points.ply";
  return file;
}

// The points of a folder, a scan or a file, with the views that saw them where that is known.
Result<PointCloud> readPoints(const std::string& input) {
  const fs::path file = pointsFile(input);
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return Error{Error::Code::kNotFound, "There is no \"" + file.string() + "\".",
                 "Name the folder of a reconstruction, a scan, or a file of points."};
  }
  auto cloud = readPointCloud(file);
  if (!cloud) return cloud;
  const fs::path visibility = file.parent_path() / "visibility.bin";
  if (file.filename() == "points.ply" && fs::exists(visibility, ignored)) {
    if (const auto read = readVisibility(visibility, *cloud); !read) return read.error();
  }
  return cloud;
}

// Where the points know their views: a cloud of another program may lie beside a scan's files.
Result<std::optional<SightEvidence>> readSightsOf(const Words& words, const PointCloud& cloud) {
  const fs::path file = pointsFile(words.input);
  std::error_code ignored;
  if (file.filename() != "points.ply" ||
      !fs::exists(file.parent_path() / "visibility.bin", ignored)) {
    return std::optional<SightEvidence>();
  }
  return readSights(file.parent_path(), cloud);
}

// --keep-pieces speaks to the clean-up, --min-component to the making; both hold for both.
double leastShare(const Words& words) {
  return words.clean.min_component_share == 0.0 ? 0.0 : words.cut.min_component_share;
}

Result<MeshRequest> requestOf(const Words& words) {
  if (const auto known = checkModelEnding(words.out); !known) return known.error();
  MeshRequest request;
  const auto method = meshMethodOf(words.method);
  if (!method) {
    return Error{Error::Code::kInvalidInput,
                 "This version cannot make a mesh by the method \"" + words.method + "\".",
                 "Use one of auto, alpha, adaptive, closed and watertight."};
  }
  request.method = *method;
  request.cut = words.cut;
  request.cut.min_component_share = leastShare(words);
  request.alpha.alpha_mm = words.alpha_mm;
  request.alpha.spacing_mm = words.cut.spacing_mm;
  request.alpha.min_component_share = leastShare(words);
  request.wrap.alpha_mm = words.alpha_mm;
  if (const auto valid = words.clean.validate(); !valid) return valid.error();
  return request;
}

// What the user asked to be cleaned; nothing where the mesh shall stay as it is made.
bool wantsCleaning(const CleanOptions& clean) {
  const CleanOptions nothing;
  return clean.base_cap || clean.smooth.iterations > 0 || clean.decimate.triangles > 0 ||
         clean.remesh.edge_mm > 0.0 || clean.holes.max_width_mm > 0.0 ||
         clean.crop.radius_mm > 0.0 || clean.crop.z_min_mm != nothing.crop.z_min_mm ||
         clean.crop.z_max_mm != nothing.crop.z_max_mm;
}

// The report beside the points shows the folder's own mesh: it is written anew with that.
Result<void> refreshPage(const Words& words) {
  const fs::path folder = fs::absolute(words.out).parent_path();
  std::error_code ignored;
  const bool own =
      fs::path(words.out).filename() == "mesh.ply" &&
      fs::equivalent(folder, fs::absolute(pointsFile(words.input)).parent_path(), ignored);
  if (!own || !fs::exists(folder / "report.json", ignored)) return {};
  return writeReportPage(folder);
}

int run(const Words& words, Console& console, const Task& task) {
  const auto request = requestOf(words);
  if (!request) return console.wrongUse(request.error());
  const auto cloud = readPoints(words.input);
  if (!cloud) return console.fail(cloud.error());
  const auto sights = readSightsOf(words, *cloud);
  if (!sights) return console.fail(sights.error());
  const bool cleaning = wantsCleaning(words.clean);
  auto made = makeMesh(*cloud, *sights, *request, task.part(0.0, cleaning ? 0.6 : 1.0));
  if (!made) return console.fail(made.error());
  CleanOptions clean = words.clean;
  clean.min_component_share = leastShare(words);
  std::optional<CleanReport> cleaned;
  if (cleaning) {
    auto result = cleanMesh(made->mesh, clean, task.part(0.6, 1.0));
    if (!result) return console.fail(result.error());
    made->mesh = std::move(result->mesh);
    cleaned = std::move(result->report);
  }
  const auto written = writeModel(words.out, made->mesh, labelOfScan(words.input));
  if (!written) return console.fail(written.error());
  if (const auto told = refreshPage(words); !told) return console.fail(told.error());
  tellMesh(console, *made, cleaned, movedAlongZ_mm(words.out, made->mesh));
  return kDone;
}

}  // namespace

void addMesh(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("mesh", "Make a mesh of measured points");
  command->add_option("points", words->input, "A result's folder, a scan, or points.ply")
      ->required();
  command
      ->add_option("--method", words->method,
                   "How: auto, alpha, adaptive, closed or watertight (default auto: closed where "
                   "the lines of sight are known, else alpha)")
      ->check(CLI::IsMember({"auto", "alpha", "adaptive", "closed", "watertight", "silhouette"}));
  command->add_option("--alpha", words->alpha_mm, "Radius that bridges gaps, in mm")
      ->check(CLI::Range(1e-3, 1000.0));
  command->add_option("--out", words->out, "File to write: .ply, .obj, .stl, .3mf or .glb")
      ->required();
  addOptionWords(*command, OptionList::of(words->cut), "Fine tuning");
  addCleanWords(*command, words->clean);
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
