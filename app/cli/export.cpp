// gyre export: a result for other programs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "core/pipeline/export_pictures.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

struct Words {
  std::string input;
  std::string to;
  std::string images;
  std::string out;
  bool link = false;
};

int run(const Words& words, Console& console, const Task& task) {
  ExportRequest request;
  request.folder = words.input;
  if (request.folder.extension() == ".gyre") {
    request.folder = fs::absolute(request.folder).parent_path();
  }
  request.pictures = words.images;
  request.out = words.out;
  request.kind = words.to == "colmap" ? ExportKind::kColmap : ExportKind::kTransforms;
  if (words.link) request.transfer = PictureTransfer::kLink;
  const auto summary = exportPictures(request, task);
  if (!summary) return console.fail(summary.error());
  console.say(std::to_string(summary->pictures) + " pictures with their cameras, " +
              std::to_string(summary->masks) + " masks and " + std::to_string(summary->points) +
              " points are in " + words.out + ", in millimetres.");
  if (request.kind == ExportKind::kColmap && summary->sightings == 0) {
    console.warn(
        "The points have no tracks: the result does not keep where they were seen. Reconstruct "
        "again to have them.");
  }
  return kDone;
}

}  // namespace

void addExport(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("export", "Hand pictures, cameras, masks and points to another program");
  command->add_option("result", words->input, "A result's folder or a scan")->required();
  command
      ->add_option("--to", words->to,
                   "colmap: a text model; transforms: transforms.json of NeRF programs")
      ->required()
      ->check(CLI::IsMember({"colmap", "transforms"}));
  command->add_option("--out", words->out, "Folder to write to")->required();
  command->add_option("--images", words->images,
                      "Where the pictures lie, when they are no longer where they were");
  command->add_flag("--link", words->link, "Link the pictures instead of copying them");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
