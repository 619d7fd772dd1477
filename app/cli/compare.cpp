// gyre compare: how far a result lies from a reference, in mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "core/io/atomic_file.h"
#include "core/io/json_text.h"
#include "core/io/model_file.h"
#include "core/mesh/compare.h"

namespace gyre {
namespace {

struct Words {
  std::string result;
  std::string reference;
  std::string json_file;
  CompareOptions options;
  bool align = false;
};

Result<Mesh> readSurface(const std::string& file) {
  auto model = readMeshOrCloud(file);
  if (!model) return model.error();
  if (auto* mesh = std::get_if<Mesh>(&model.value())) return std::move(*mesh);
  return meshOfPoints(std::get<PointCloud>(*model));
}

std::string jsonText(const Comparison& comparison) {
  std::string text = "{\n  \"accuracy_mm\": {\"mean\": " + jsonNumber(comparison.mean_mm) +
                     ", \"median\": " + jsonNumber(comparison.median_mm) +
                     ", \"p95\": " + jsonNumber(comparison.p95_mm) + "},\n  \"at_mm\": [";
  const char* comma = "";
  for (const ComparisonAt& at : comparison.at) {
    text += comma + ("\n    {\"d\": " + jsonNumber(at.d_mm)) +
            ", \"precision\": " + jsonNumber(at.precision) +
            ", \"completeness\": " + jsonNumber(at.completeness) + ", \"f\": " + jsonNumber(at.f) +
            "}";
    comma = ",";
  }
  return text + "\n  ]\n}\n";
}

std::string plainText(const Comparison& comparison) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << "Distance to the reference: mean "
       << comparison.mean_mm << " mm, median " << comparison.median_mm << " mm, 95 % within "
       << comparison.p95_mm << " mm.";
  for (const ComparisonAt& at : comparison.at) {
    text << std::setprecision(3) << "\nWithin " << at.d_mm << " mm: precision "
         << std::setprecision(1) << 100.0 * at.precision << " %, completeness "
         << 100.0 * at.completeness << " %, F-score " << 100.0 * at.f << " %.";
  }
  return text.str();
}

int run(Words& words, Console& console, const Task& task) {
  if (words.align) words.options.alignment = Alignment::kRigid;
  if (const auto valid = words.options.validate(); !valid) return console.wrongUse(valid.error());
  const auto result = readSurface(words.result);
  if (!result) return console.fail(result.error());
  const auto reference = readSurface(words.reference);
  if (!reference) return console.fail(reference.error());
  const auto comparison = compareSurfaces(*result, *reference, words.options, task);
  if (!comparison) return console.fail(comparison.error());
  if (!words.json_file.empty()) {
    const auto written = writeFileAtomically(words.json_file, jsonText(*comparison));
    if (!written) return console.fail(written.error());
  }
  console.say(plainText(*comparison));
  return kDone;
}

}  // namespace

void addCompare(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("compare", "Measure how far a cloud or mesh lies from another");
  command->add_option("result", words->result, "The cloud or mesh to judge")->required();
  command->add_option("reference", words->reference, "What it is held against")->required();
  command->add_option("--json", words->json_file, "Write the numbers to this file too");
  command->add_option("--at", words->options.at_mm, "Distances in mm (default 0.25,0.5,1)")
      ->delimiter(',');
  command->add_flag("--align", words->align, "Move and turn the result to fit first");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
