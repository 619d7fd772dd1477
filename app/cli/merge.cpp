// gyre merge: one model of several scans of an object that was turned over between them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/calibration_run.h"
#include "app/cli/mesh_ending.h"
#include "app/cli/subcommands.h"
#include "app/version.h"
#include "core/base/formatted.h"
#include "core/mesh/clean/self_intersections.h"
#include "core/mesh/mesh_health.h"
#include "core/pipeline/merge/merge_passes.h"

namespace gyre {
namespace {

struct Words {
  std::vector<std::string> passes;
  std::string out;
};

void tell(Console& console, const MergedPasses& merged) {
  for (const ScanPass& pass : merged.passes) {
    if (!pass.fit) continue;
    console.say(
        formatted("%s: %zu spots of its surface were found again (%.2f mm, median); %.0f %% of its "
                  "points lie "
                  "on surface that another pass saw, %.3f mm from it (median).",
                  pass.folder.string().c_str(), pass.fit->spots, pass.fit->spots_mm,
                  100.0 * pass.fit->overlap, pass.fit->residual_mm));
  }
}

int run(const Words& words, Console& console, const Task& task) {
  MergeRequest request;
  request.passes.assign(words.passes.begin(), words.passes.end());
  request.out = words.out;
  request.report.date = nowUtcText();
  request.report.versions["Gyre"] = programVersion();
  const auto merged = mergePasses(request, task);
  if (!merged) return console.fail(merged.error());
  tell(console, *merged);
  console.say(std::to_string(merged->cloud.points.size()) + " points are in " + words.out + ".");
  if (merged->mesh_problem) return console.fail(*merged->mesh_problem);
  // All is written: a stop now only leaves the self-intersections uncounted.
  const auto health = wholeHealth(merged->mesh, task);
  tellMesh(console, {merged->mesh, MeshMethod::kClosed, 0.0},
           health ? *health : meshHealth(merged->mesh), {}, 0.0);
  return kDone;
}

}  // namespace

void addMerge(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand(
      "merge", "Make one model of several scans of an object that was turned over between them");
  command
      ->add_option("passes", words->passes,
                   "Two or more scans or results' folders; the model stands as in the first")
      ->required()
      ->expected(2, 1000);
  command->add_option("--out", words->out, "Folder to write to")->required();
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
