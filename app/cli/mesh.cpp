// gyre mesh: a surface through points that were measured before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/clean_words.h"
#include "app/cli/mesh_ending.h"
#include "app/cli/mesh_input.h"
#include "app/cli/option_words.h"
#include "app/cli/subcommands.h"
#include "core/io/model_label.h"
#include "core/io/model_writer.h"
#include "core/mesh/clean/clean_mesh.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/pipeline/colour_mesh.h"
#include "core/pipeline/make_mesh.h"
#include "core/pipeline/report_page.h"
#include "core/pipeline/result_pictures.h"

namespace gyre {
namespace {

constexpr std::array<std::string_view, 3> kHullWords = {"hull-cell", "hull-gap",
                                                        "hull-disbelieved"};

struct Words {
  std::string input;
  std::string method = "auto";
  double alpha_mm = 0.0;
  VisibilityCutOptions cut;
  VisualHullOptions hull;
  std::string pictures;
  CleanOptions clean;
  std::string out;
};

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
                 "Use one of auto, alpha, adaptive, closed, watertight, poisson and silhouette."};
  }
  request.method = *method;
  request.cut = words.cut;
  request.cut.min_component_share = leastShare(words);
  request.hull = words.hull;
  request.hull.min_component_share = leastShare(words);
  request.alpha.alpha_mm = words.alpha_mm;
  request.poisson.spacing_mm = words.cut.spacing_mm;
  request.alpha.spacing_mm = words.cut.spacing_mm;
  request.alpha.min_component_share = leastShare(words);
  request.wrap.alpha_mm = words.alpha_mm;
  if (const auto valid = words.clean.validate(); !valid) return valid.error();
  return request;
}

// Where the vertices are not the points, or where it is asked for, the pictures tell the colours.
Result<void> colour(Mesh& mesh, const Words& words, MeshMethod method, const MeshInput& input,
                    const Task& task) {
  const bool found = method == MeshMethod::kSilhouette && !firstPictureOf(input.folder).empty();
  if (words.pictures.empty() && !found) return {};
  const PictureFinder pictures(input.folder, words.pictures);
  const auto coloured = colourFromPictures(mesh, input.folder, pictures, task);
  if (!coloured) return coloured.error();
  return {};
}

// The report beside the points shows the folder's own mesh: it is written anew with that.
Result<void> refreshPage(const Words& words, const std::filesystem::path& folder) {
  const std::filesystem::path out = words.out;
  std::error_code ignored;
  const bool own = out.filename() == "mesh.ply" &&
                   std::filesystem::equivalent(std::filesystem::absolute(out).parent_path(),
                                               std::filesystem::absolute(folder), ignored);
  return own ? refreshReportPage(folder) : Result<void>{};
}

int run(const Words& words, Console& console, const Task& task) {
  const auto request = requestOf(words);
  if (!request) return console.wrongUse(request.error());
  const auto input = readMeshInput(words.input, request->method);
  if (!input) return console.fail(input.error());
  CleanOptions clean = words.clean;
  clean.min_component_share = leastShare(words);
  const bool cleaning = changesShape(clean);
  auto made = makeMesh(input->cloud, input->sights, *request, task.part(0.0, cleaning ? 0.5 : 0.8));
  if (!made) return console.fail(made.error());
  std::optional<CleanReport> cleaned;
  if (cleaning) {
    auto result = cleanMesh(made->mesh, clean, task.part(0.5, 0.8));
    if (!result) return console.fail(result.error());
    made->mesh = std::move(result->mesh);
    cleaned = std::move(result->report);
  }
  const auto coloured = colour(made->mesh, words, made->method, *input, task.part(0.8, 0.95));
  if (!coloured) return console.fail(coloured.error());
  const auto health = wholeHealth(made->mesh, task.part(0.95, 1.0));
  if (!health) return console.fail(health.error());
  const auto written = writeModel(words.out, made->mesh, labelOfScan(words.input));
  if (!written) return console.fail(written.error());
  if (const auto told = refreshPage(words, input->folder); !told) return console.fail(told.error());
  tellMesh(console, *made, *health, cleaned, movedAlongZ_mm(words.out, made->mesh));
  return kDone;
}

}  // namespace

void addMesh(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("mesh", "Make a mesh of measured points");
  command->add_option("points", words->input, "A result's folder, a scan, or points.ply")
      ->required();
  command
      ->add_option(
          "--method", words->method,
          "How: auto, alpha, adaptive, closed, watertight, poisson or silhouette (default auto: "
          "closed where the lines of sight are known, else alpha)")
      ->check(CLI::IsMember(
          {"auto", "alpha", "adaptive", "closed", "watertight", "poisson", "silhouette"}));
  command->add_option("--alpha", words->alpha_mm, "Radius that bridges gaps, in mm")
      ->check(CLI::Range(1e-3, 1000.0));
  command->add_option("--out", words->out, "File to write: .ply, .obj, .stl, .3mf or .glb")
      ->required();
  command->add_option("--pictures", words->pictures,
                      "Folder of the scan's pictures: colours are taken from them");
  addOptionWords(*command, OptionList::of(words->cut), "Fine tuning");
  addOptionWords(*command, OptionList::of(words->hull), kHullWords, "Fine tuning");
  addCleanWords(*command, words->clean);
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
