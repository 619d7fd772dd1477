// gyre reconstruct: points and a mesh from pictures that were taken before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/calibration_run.h"
#include "app/cli/find_unknowns.h"
#include "app/cli/option_words.h"
#include "app/cli/scan_ending.h"
#include "app/cli/subcommands.h"
#include "app/version.h"
#include "core/base/units.h"
#include "core/io/result_folder.h"
#include "core/pipeline/reconstruct.h"
#include "core/pipeline/write_results.h"

namespace gyre {
namespace {

struct Words {
  PictureSet set;
  std::string step_deg;
  UnknownRig rig;
  std::string out;
  ReconstructOptions options;
};

Result<void> readStep(const std::string& text, PictureSet& set) {
  set.find_steps = text == "auto";
  if (text.empty() || set.find_steps) return {};
  double step_deg = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, step_deg);
  if (problem == std::errc{} && stop == end) {
    set.step_rad = radFromDeg(step_deg);
    return {};
  }
  return Error{Error::Code::kInvalidInput, "\"" + text + "\" is not a step in degrees.",
               "Write a number, such as --step-deg 1.8, or auto."};
}

ResultContext contextOf(const PictureSet& set, const PreparedPictures& prepared,
                        const ReconstructOptions& options) {
  ResultContext context;
  context.calibration = prepared.calibration;
  for (const PictureView& view : prepared.views) {
    context.angles[view.name] = view.table_angle_rad;
    context.pictures.push_back(view.file);
  }
  Report& report = context.report;
  report.title = set.pictures.filename().string();
  report.date = nowUtcText();
  report.versions["Gyre"] = programVersion();
  report.options = optionTexts(options);
  report.inputs["pictures"] = set.pictures.string();
  if (!set.calibration.empty()) report.inputs["calibration"] = set.calibration.string();
  if (!set.angles.empty()) report.inputs["angles"] = set.angles.string();
  if (!set.masks.empty()) report.inputs["masks"] = set.masks.string();
  if (!set.background.empty()) report.inputs["background"] = set.background.string();
  return context;
}

int run(const Words& words, Console& console, const Task& task) {
  PictureSet set = words.set;
  if (const auto step = readStep(words.step_deg, set); !step) return console.wrongUse(step.error());
  if (const auto valid = words.options.validate(); !valid) return console.wrongUse(valid.error());
  auto prepared = preparePictures(set);
  if (!prepared) return console.fail(prepared.error());
  if (const auto made = makeResultFolder(words.out); !made) return console.fail(made.error());
  ReconstructOptions options = words.options;
  const UnknownRig& rig = words.rig;
  const bool calibrated = prepared->calibration.calibration.cam_from_table.has_value();
  const double finding = !prepared->angles_told || rig.refine_camera || !calibrated ? 0.5 : 0.0;
  const auto found = findUnknowns(rig, *prepared, options, console, task.part(0.0, finding));
  if (!found) return console.fail(found.error());
  auto reconstruction = reconstruct(*prepared, options, {}, task.part(finding, 0.9));
  if (!reconstruction) return console.fail(reconstruction.error());
  const bool size_known = giveSize(rig, calibrated, *prepared, *reconstruction, console);
  ResultContext context = contextOf(set, *prepared, options);
  context.report.size_known = size_known;
  context.report.inputs.insert(found->begin(), found->end());
  const auto written = writeResults(words.out, *reconstruction, context, task.part(0.9, 1.0));
  if (!written) return console.fail(written.error());
  tellResults(console, *reconstruction, *written);
  const auto enough = enoughPoints(reconstruction->cloud, prepared->views.size());
  return enough ? static_cast<int>(kDone) : console.fail(enough.error());
}

}  // namespace

void addReconstruct(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  PictureSet& set = words->set;
  CLI::App* command =
      app.add_subcommand("reconstruct", "Make points and a mesh of pictures taken before");
  command->add_option("pictures", set.pictures, "Folder of pictures, or a scan")->required();
  command->add_option("--calibration", set.calibration,
                      "calibration.json; without one, camera and axis are found in the pictures");
  auto* angles = command->add_option("--angles", set.angles, "angles.csv: image,angle_deg");
  command
      ->add_option("--step-deg", words->step_deg,
                   "Angle from picture to picture; auto, or nothing, finds it in the pictures")
      ->excludes(angles);
  command->add_flag("--refine-camera", words->rig.refine_camera,
                    "Solve camera and axis from the object's own points as well");
  command
      ->add_option("--known-length", words->rig.known_length_mm,
                   "Longest line through the object, in mm: gives the model its size")
      ->check(CLI::Range(0.01, 1e6));
  auto* masks = command->add_option("--masks", set.masks, "Folder of masks, above 127 = object");
  command->add_option("--background", set.background, "Picture of the empty table, or a folder")
      ->excludes(masks);
  command->add_option("--out", words->out, "Folder for the results")->required();
  addOptionWords(*command, OptionList::of(words->options), "Fine tuning");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
