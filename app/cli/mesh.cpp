// gyre mesh: a surface through points that were measured before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/option_words.h"
#include "app/cli/subcommands.h"
#include "core/io/model_file.h"
#include "core/io/obj.h"
#include "core/io/ply.h"
#include "core/io/visibility_file.h"
#include "core/mesh/mesh_health.h"
#include "core/pipeline/make_mesh.h"
#include "core/pipeline/sights.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

struct Words {
  std::string input;
  std::string method = "auto";
  double alpha_mm = 0.0;
  VisibilityCutOptions cut;
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
  auto cloud = readPointCloud(file);
  if (!cloud) return cloud;
  std::error_code ignored;
  const fs::path visibility = file.parent_path() / "visibility.bin";
  if (file.filename() == "points.ply" && fs::exists(visibility, ignored)) {
    if (const auto read = readVisibility(visibility, *cloud); !read) return read.error();
  }
  return cloud;
}

Result<void> checkWords(const Words& words) {
  const std::string ending = fs::path(words.out).extension();
  if (ending != ".ply" && ending != ".obj") {
    return Error{Error::Code::kInvalidInput,
                 "\"" + words.out + "\" does not end in a known mesh format.",
                 "Let the file's name end in .ply or .obj."};
  }
  if (!meshMethodOf(words.method)) {
    return Error{Error::Code::kInvalidInput,
                 "This version cannot make a mesh by the method \"" + words.method + "\".",
                 "Use --method closed or alpha, or leave it out."};
  }
  return {};
}

std::string healthText(const MadeMesh& made) {
  const MeshHealth health = meshHealth(made.mesh);
  std::ostringstream text;
  if (made.method == MeshMethod::kAlpha) {
    text << "Alpha shape, alpha " << std::setprecision(3) << made.alpha_mm << " mm: ";
  } else {
    text << "Visibility cut: ";
  }
  text << health.vertices << " vertices, " << health.triangles << " triangles, "
       << health.components << (health.components == 1 ? " component, " : " components, ")
       << (health.closed ? "closed" : "open where no camera looked") << ".";
  return text.str();
}

int run(const Words& words, Console& console, const Task& task) {
  if (const auto checked = checkWords(words); !checked) return console.wrongUse(checked.error());
  MeshRequest request;
  request.method = *meshMethodOf(words.method);
  request.cut = words.cut;
  request.alpha.alpha_mm = words.alpha_mm;
  request.alpha.spacing_mm = words.cut.spacing_mm;
  request.alpha.min_component_share = words.cut.min_component_share;
  const auto cloud = readPoints(words.input);
  if (!cloud) return console.fail(cloud.error());
  const auto sights = readSights(pointsFile(words.input).parent_path(), *cloud);
  if (!sights) return console.fail(sights.error());
  const auto made = makeMesh(*cloud, *sights, request, task);
  if (!made) return console.fail(made.error());
  const fs::path out = words.out;
  const auto written =
      out.extension() == ".obj" ? writeObj(out, made->mesh) : writePly(out, made->mesh);
  if (!written) return console.fail(written.error());
  console.say(healthText(*made));
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
  command->add_option("--out", words->out, "File to write: .ply or .obj")->required();
  addOptionWords(*command, OptionList::of(words->cut), "Fine tuning");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
