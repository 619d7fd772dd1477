// gyre compare: how far a result lies from a reference, in mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "app/comparison_picture.h"
#include "core/base/formatted.h"
#include "core/io/atomic_file.h"
#include "core/io/distance_ply.h"
#include "core/io/json_text.h"
#include "core/io/model_file.h"
#include "core/mesh/compare.h"
#include "core/pipeline/distance_colours.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr double kBarWidth = 40.0;  // characters of the longest bar

struct Words {
  std::string result;
  std::string reference;
  std::string json_file;
  std::string picture_file;
  std::string colours_file;
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
  text += "\n  ],\n  \"samples\": " + std::to_string(comparison.samples) +
          ",\n  \"max_mm\": " + jsonNumber(comparison.max_mm) + ",\n  \"histogram_mm\": [";
  comma = "";
  for (const ComparisonBin& bin : comparison.histogram) {
    text += comma + ("\n    {\"from\": " + jsonNumber(bin.from_mm)) +
            ", \"to\": " + jsonNumber(bin.to_mm) + ", \"share\": " + jsonNumber(bin.share) + "}";
    comma = ",";
  }
  return text + "\n  ]\n}\n";
}

// A bar of characters for every bin.
std::string histogramText(const Comparison& comparison) {
  double most = 0.0;
  for (const ComparisonBin& bin : comparison.histogram) most = std::max(most, bin.share);
  std::string text = "How often which distance occurs:";
  for (const ComparisonBin& bin : comparison.histogram) {
    const auto bars = static_cast<std::size_t>(std::lround(kBarWidth * bin.share / most));
    text +=
        formatted("\n%10.4g to %10.4g mm %6.2f %% ", bin.from_mm, bin.to_mm, 100.0 * bin.share) +
        std::string(bars, '#');
  }
  return text;
}

// What --picture and --colours ask for.
Result<void> writePictures(const Words& words, const Mesh& result, const Mesh& reference,
                           const Comparison& comparison, const Task& task) {
  if (words.picture_file.empty() && words.colours_file.empty()) return {};
  Mesh moved = result;
  for (MeshVertex& vertex : moved.vertices) {
    vertex.position = comparison.reference_from_result * vertex.position;
    vertex.normal = comparison.reference_from_result.rotation * vertex.normal;
  }
  task.report(0.0, "Painting");
  const auto distances_mm = vertexDistances(moved, reference, task);
  if (!distances_mm) return distances_mm.error();
  if (!words.colours_file.empty()) {
    Mesh coloured = moved;
    colourByDistance(coloured, *distances_mm, comparison.scale_mm);
    const std::string scale = formatted("viridis from 0 to %.4g mm", comparison.scale_mm);
    const auto done =
        writeFileAtomically(words.colours_file, distancePlyBytes(coloured, *distances_mm, scale));
    if (!done) return done;
  }
  if (words.picture_file.empty()) return {};
  const auto missing_mm = vertexDistances(reference, moved, task);
  if (!missing_mm) return missing_mm.error();
  const std::vector<PaintedShape> shapes = {
      {"The result, by its distance from the reference", moved, *distances_mm},
      {"The reference, by its distance from the result", reference, *missing_mm}};
  return writeComparisonPicture(words.picture_file, shapes, comparison);
}

Result<void> checkNames(const Words& words) {
  const auto ends = [](const std::string& file, const char* ending) {
    return file.empty() || fs::path(file).extension() == ending;
  };
  if (!ends(words.picture_file, ".png")) {
    return Error{Error::Code::kInvalidInput, "The picture is written as PNG only.",
                 "Give --picture a name that ends in .png."};
  }
  if (!ends(words.colours_file, ".ply")) {
    return Error{Error::Code::kInvalidInput, "The coloured shape is written as PLY only.",
                 "Give --colours a name that ends in .ply."};
  }
  return {};
}

int run(Words& words, Console& console, const Task& task) {
  if (words.align) words.options.alignment = Alignment::kRigid;
  if (const auto valid = words.options.validate(); !valid) return console.wrongUse(valid.error());
  if (const auto valid = checkNames(words); !valid) return console.wrongUse(valid.error());
  const auto result = readSurface(words.result);
  if (!result) return console.fail(result.error());
  const auto reference = readSurface(words.reference);
  if (!reference) return console.fail(reference.error());
  if (const auto doubt = unitDoubt(*result, *reference)) {
    if (doubt->certain) return console.fail(doubt->words);
    console.warn(doubt->words.sentence());
  }
  const auto comparison = compareSurfaces(*result, *reference, words.options, task.part(0.0, 0.8));
  if (!comparison) return console.fail(comparison.error());
  if (!words.json_file.empty()) {
    const auto written = writeFileAtomically(words.json_file, jsonText(*comparison));
    if (!written) return console.fail(written.error());
  }
  const auto painted = writePictures(words, *result, *reference, *comparison, task.part(0.8, 1.0));
  if (!painted) return console.fail(painted.error());
  console.say(comparisonText(*comparison));
  console.note(histogramText(*comparison));
  if (!words.colours_file.empty()) {
    console.say(
        formatted("Colours: dark violet 0 mm, yellow %.4g mm and more.", comparison->scale_mm));
  }
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
  command->add_option("--picture", words->picture_file,
                      "Paint the distances from four sides, with a scale and a histogram: a .png");
  command->add_option("--colours", words->colours_file,
                      "Write the result coloured by its distance, and the distance: a .ply");
  command->add_option("--at", words->options.at_mm, "Distances in mm (default 0.25,0.5,1)")
      ->delimiter(',');
  command
      ->add_option("--scale", words->options.scale_mm,
                   "Where colours and histogram end, in mm; without it by the distances")
      ->check(CLI::Range(1e-6, 1e6));
  command
      ->add_option("--seen-by", words->options.min_views_seen,
                   "Only surface of the reference that so many views saw counts: truth.ply tells")
      ->check(CLI::Range(0.0, 1e6));
  command
      ->add_option("--above", words->options.min_height_mm,
                   "Only what of the result lies higher counts, in mm: leaves the platter out")
      ->check(CLI::Range(-1e6, 1e6));
  command->add_flag("--align", words->align, "Move and turn the result to fit first");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
