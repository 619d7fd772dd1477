// gyre mesh: a surface through points that were measured before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "core/io/model_file.h"
#include "core/io/model_writer.h"
#include "core/io/visibility_file.h"
#include "core/mesh/alpha_shape.h"
#include "core/mesh/mesh_health.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

struct Words {
  std::string input;
  std::string method = "auto";
  double alpha_mm = 0.0;
  std::string out;
};

// The points of a folder, a scan or a file, with the views that saw them where that is known.
Result<PointCloud> readPoints(const std::string& input) {
  fs::path file = input;
  std::error_code ignored;
  if (file.extension() == ".gyre") file = file.parent_path() / "points.ply";
  if (fs::is_directory(file, ignored)) file /= "points.ply";
  auto cloud = readPointCloud(file);
  if (!cloud) return cloud;
  const fs::path visibility = file.parent_path() / "visibility.bin";
  if (file.filename() == "points.ply" && fs::exists(visibility, ignored)) {
    if (const auto read = readVisibility(visibility, *cloud); !read) return read.error();
  }
  return cloud;
}

Result<void> checkWords(const Words& words) {
  if (const auto known = checkModelEnding(words.out); !known) return known;
  if (words.method != "auto" && words.method != "alpha") {
    return Error{Error::Code::kInvalidInput,
                 "This version cannot make a mesh by the method \"" + words.method + "\".",
                 "Use --method alpha, or leave it out."};
  }
  return {};
}

std::string healthText(const AlphaShapeMesh& surface) {
  const MeshHealth health = meshHealth(surface.mesh);
  std::ostringstream text;
  text << "Alpha shape, alpha " << std::setprecision(3) << surface.alpha_mm
       << " mm: " << health.vertices << " vertices, " << health.triangles << " triangles, "
       << health.components << (health.components == 1 ? " component, " : " components, ")
       << (health.closed ? "closed" : "open where no camera looked") << ".";
  return text.str();
}

std::string movedText(double moved_mm) {
  if (std::abs(moved_mm) < 0.0005) return "";
  std::ostringstream text;
  text << " Moved by " << std::fixed << std::setprecision(3) << moved_mm
       << " mm along z to stand on the bed.";
  return text.str();
}

int run(const Words& words, Console& console, const Task& task) {
  if (const auto checked = checkWords(words); !checked) return console.wrongUse(checked.error());
  const auto cloud = readPoints(words.input);
  if (!cloud) return console.fail(cloud.error());
  AlphaShapeOptions options;
  options.alpha_mm = words.alpha_mm;
  const auto surface = alphaShapeMesh(*cloud, options, task);
  if (!surface) return console.fail(surface.error());
  const auto written = writeModel(words.out, surface->mesh, labelOfScan(words.input));
  if (!written) return console.fail(written.error());
  console.say(healthText(*surface) + movedText(movedAlongZ_mm(words.out, surface->mesh)));
  return kDone;
}

}  // namespace

void addMesh(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("mesh", "Make a mesh of measured points");
  command->add_option("points", words->input, "A result's folder, a scan, or points.ply")
      ->required();
  command->add_option("--method", words->method, "How: auto or alpha (default auto)")
      ->check(CLI::IsMember({"auto", "alpha", "adaptive", "closed", "watertight", "silhouette"}));
  command->add_option("--alpha", words->alpha_mm, "Radius that bridges gaps, in mm")
      ->check(CLI::Range(1e-3, 1000.0));
  command->add_option("--out", words->out, "File to write: .ply, .obj, .stl, .3mf or .glb")
      ->required();
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
