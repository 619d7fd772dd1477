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

#include "app/cli/option_words.h"
#include "app/cli/scan_ending.h"
#include "app/cli/subcommands.h"
#include "app/version.h"
#include "core/base/formatted.h"
#include "core/base/units.h"
#include "core/io/result_folder.h"
#include "core/pipeline/find_angles.h"
#include "core/pipeline/reconstruct.h"
#include "core/pipeline/write_results.h"

namespace gyre {
namespace {

struct Words {
  PictureSet set;
  std::string step_deg;
  std::string out;
  ReconstructOptions options;
};

Result<void> readStep(const std::string& text, PictureSet& set) {
  if (text.empty()) return {};
  if (text == "auto") {
    set.find_steps = true;
    return {};
  }
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
  for (const PictureView& view : prepared.views) context.angles[view.name] = view.table_angle_rad;
  Report& report = context.report;
  report.title = set.pictures.filename().string();
  report.versions["Gyre"] = programVersion();
  report.options = optionTexts(options);
  report.inputs["pictures"] = set.pictures.string();
  if (!set.calibration.empty()) report.inputs["calibration"] = set.calibration.string();
  if (!set.angles.empty()) report.inputs["angles"] = set.angles.string();
  if (!set.masks.empty()) report.inputs["masks"] = set.masks.string();
  if (!set.background.empty()) report.inputs["background"] = set.background.string();
  return context;
}

// As pairs of pictures tell an angle; the points tell it better.
constexpr double kFoundAngles_deg = 0.3;

void tellSteps(Console& console, const TurnSteps& steps) {
  console.say(formatted("Steps of %.3f deg, %s seen from above, found in %zu matches%s.",
                        std::abs(degFromRad(steps.common_rad)),
                        steps.common_rad > 0.0 ? "counter-clockwise" : "clockwise", steps.agreeing,
                        steps.closed ? "; whole turns" : ""));
}

int run(const Words& words, Console& console, const Task& task) {
  PictureSet set = words.set;
  if (const auto step = readStep(words.step_deg, set); !step) return console.wrongUse(step.error());
  if (const auto valid = words.options.validate(); !valid) return console.wrongUse(valid.error());
  auto prepared = preparePictures(set);
  if (!prepared) return console.fail(prepared.error());
  if (const auto made = makeResultFolder(words.out); !made) return console.fail(made.error());
  ReconstructOptions options = words.options;
  if (set.find_steps) {
    const auto steps = findAngles(*prepared, task.part(0.0, 0.3));
    if (!steps) return console.fail(steps.error());
    tellSteps(console, *steps);
    options.recover.angle_freedom_deg =
        std::max(options.recover.angle_freedom_deg, kFoundAngles_deg);
  }
  const auto reconstruction =
      reconstruct(*prepared, options, {}, task.part(set.find_steps ? 0.3 : 0.0, 0.9));
  if (!reconstruction) return console.fail(reconstruction.error());
  const auto written = writeResults(words.out, *reconstruction, contextOf(set, *prepared, options),
                                    task.part(0.9, 1.0));
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
  command->add_option("--calibration", set.calibration, "calibration.json");
  auto* angles = command->add_option("--angles", set.angles, "angles.csv: image,angle_deg");
  command
      ->add_option("--step-deg", words->step_deg,
                   "Angle from picture to picture, or auto to find it")
      ->excludes(angles);
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
