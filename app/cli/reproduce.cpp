// gyre reproduce: the paper's experiments once more, as tables and pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "core/base/formatted.h"
#include "core/io/experiment_files.h"
#include "core/io/picture_file.h"
#include "core/io/result_folder.h"
#include "core/pipeline/reproduce/acquisition.h"
#include "core/pipeline/reproduce/cube_experiment.h"
#include "core/pipeline/reproduce/noise_experiment.h"

namespace gyre {
namespace {

struct Words {
  int table = 0;         // 0: all
  bool figures = false;  // nothing but the figures
  std::string out;
  NoiseExperimentOptions noise;
};

using Experiment = std::function<Result<ExperimentTable>(const Task& task)>;

// The figures are written on the way.
Result<ExperimentTable> acquireFigures(const std::string& folder, const Task& task) {
  auto acquired = acquisitionExperiment({}, task);
  if (!acquired) return acquired.error();
  for (const AcquisitionFigure& figure : acquired->figures) {
    const auto file = std::filesystem::path(folder) / (figure.name + ".png");
    if (const auto done = writePicture(file, figure.picture_bgr); !done) return done.error();
  }
  return std::move(acquired->table);
}

std::vector<Experiment> experimentsOf(const Words& words) {
  const std::vector<Experiment> all = {
      [&](const Task& task) { return pixelNoiseExperiment(words.noise, task); },
      [&](const Task& task) { return angleNoiseExperiment(words.noise, task); },
      [](const Task& task) { return cubeExperiment({}, task); },
      [&](const Task& task) { return acquireFigures(words.out, task); }};
  if (words.figures) return {all.back()};
  if (words.table == 0) return all;
  return {all[static_cast<std::size_t>(words.table - 1)]};
}

// Numbers of three digits under their keys.
std::string textOf(const ExperimentTable& table) {
  std::string text;
  std::vector<int> widths;
  widths.reserve(table.columns.size());
  for (const ExperimentColumn& column : table.columns) {
    widths.push_back(static_cast<int>(std::max<std::size_t>(column.key.size(), 7)));
    text += formatted("%*s ", widths.back(), column.key.c_str());
  }
  for (const auto& row : table.rows) {
    text += "\n";
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += formatted("%*s ", widths[i], row[i] ? formatted("%.3g", *row[i]).c_str() : "-");
    }
  }
  return text;
}

int run(const Words& words, Console& console, const Task& task) {
  if (const auto made = makeResultFolder(words.out); !made) return console.fail(made.error());
  const std::vector<Experiment> experiments = experimentsOf(words);
  const auto count = static_cast<double>(experiments.size());
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const auto at = static_cast<double>(i);
    const auto table = experiments[i](task.part(at / count, (at + 1.0) / count));
    if (!table) return console.fail(table.error());
    if (const auto done = writeExperiment(words.out, *table); !done) {
      return console.fail(done.error());
    }
    console.say(words.out + "/" + table->name + ".csv, .json and .svg: " + table->caption);
    console.say(textOf(*table));
  }
  return kDone;
}

}  // namespace

void addReproduce(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("reproduce", "Rerun the experiments of the paper that Gyre follows");
  auto* table =
      command
          ->add_option("--table", words->table,
                       "One of the paper's tables: 1, 2 or 3 (default all, and the figures)")
          ->check(CLI::Range(1, 3));
  command->add_flag("--figures", words->figures, "Only the figures: cube, duck and mouse scanned")
      ->excludes(table);
  command
      ->add_option("--trials", words->noise.trials, "Trials a row of tables 1 and 2 (default 200)")
      ->check(CLI::Range(1, 100000));
  command->add_option("--seed", words->noise.seed, "Draws other points and noise")
      ->check(CLI::Range(0, 2147483647));
  command->add_option("--out", words->out, "Folder for the tables and plots")->required();
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
