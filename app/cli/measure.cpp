// gyre measure: the length between two places of a model, with its ±.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/calibration_run.h"
#include "app/cli/subcommands.h"
#include "core/base/formatted.h"
#include "core/io/measurements_file.h"
#include "core/io/model_file.h"
#include "core/io/report_reader.h"
#include "core/mesh/compare.h"
#include "core/mesh/point_precision.h"
#include "core/pipeline/report_page.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr double kFarShare = 0.05;  // of the model's size: so far off the surface is no place on it
constexpr double kToldMove_mm = 0.05;

struct Words {
  std::string input;
  std::vector<double> from_mm;
  std::vector<double> to_mm;
  std::optional<double> caliper_mm;
  std::string note;
};

// A model to measure on, and what tells how well it is known.
struct Measured {
  Mesh surface;                      // without triangles where there are points only
  std::optional<PointCloud> points;  // measured, with covariances
  ModelScale scale;
};

// The folder of a result or a scan; empty when a file is named.
fs::path folderOf(const std::string& input) {
  const fs::path path = input;
  std::error_code ignored;
  if (path.extension() == ".gyre") return fs::absolute(path, ignored).parent_path();
  return fs::is_directory(path, ignored) ? path : fs::path();
}

Result<Measured> readFile(const fs::path& file) {
  auto model = readMeshOrCloud(file);
  if (!model) return model.error();
  Measured measured;
  if (auto* mesh = std::get_if<Mesh>(&*model)) {
    measured.surface = std::move(*mesh);
  } else {
    measured.points = std::move(std::get<PointCloud>(*model));
    measured.surface = meshOfPoints(*measured.points);
  }
  return measured;
}

Result<Measured> readFolder(const fs::path& folder) {
  std::error_code ignored;
  const bool meshed = fs::exists(folder / "mesh.ply", ignored);
  const bool pointed = fs::exists(folder / "points.ply", ignored);
  if (!meshed && !pointed) {
    return Error{Error::Code::kNotFound,
                 "There is neither mesh.ply nor points.ply in \"" + folder.string() + "\".",
                 "Name the folder of a finished scan or reconstruction, or a model's file."};
  }
  auto measured = readFile(folder / (meshed ? "mesh.ply" : "points.ply"));
  if (!measured) return measured;
  if (meshed && pointed) {
    auto points = readPointCloud(folder / "points.ply");
    if (!points) return points.error();
    measured->points = std::move(*points);
  }
  measured->scale = scaleOfResult(folder);
  return measured;
}

Result<PickedPoint> pick(const Measured& model, const SurfaceIndex& surface,
                         const PointPrecision& precision, const std::vector<double>& place) {
  const Eigen::Vector3d asked(place[0], place[1], place[2]);
  PickedPoint picked = pickNearest(model.surface, surface, precision, asked);
  const double off_mm = (picked.position - asked).norm();
  if (!(off_mm <= kFarShare * boundsOf(model.surface).diagonal())) {
    return Error{Error::Code::kInvalidInput,
                 formatted("The place %g,%g,%g is %.3g mm away from the model.", place[0], place[1],
                           place[2], off_mm),
                 "Give places on the surface, in mm as the model's own coordinates are."};
  }
  return picked;
}

Result<Measurement> measure(const Words& words, const Measured& model, Console& console) {
  const SurfaceIndex surface(model.surface);
  const PointPrecision precision =
      model.points ? PointPrecision(*model.points) : PointPrecision(model.surface);
  std::array<PickedPoint, 2> ends;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::vector<double>& place = i == 0 ? words.from_mm : words.to_mm;
    const auto picked = pick(model, surface, precision, place);
    if (!picked) return picked.error();
    ends[i] = *picked;
    const double moved_mm =
        (picked->position - Eigen::Vector3d(place[0], place[1], place[2])).norm();
    const char* which = i == 0 ? "from" : "to";
    if (moved_mm > kToldMove_mm) {
      console.say(formatted("--%s was moved by %.3f mm to the surface.", which, moved_mm));
    }
    if (!picked->seen) {
      console.warn(formatted("No camera saw the surface at --%s: it was guessed.", which));
    }
  }
  return measureLength(ends[0], ends[1], model.scale);
}

void tell(Console& console, const Measurement& measurement) {
  console.say(lengthText(measurement));
  console.say(uncertaintyText(measurement));
  if (measurement.caliper_mm) console.say(caliperText(measurement));
}

int list(const fs::path& folder, Console& console) {
  const auto all = readMeasurements(folder / "measurements.json");
  if (!all && all.error().code != Error::Code::kNotFound) return console.fail(all.error());
  if (!all || all->empty()) {
    console.say("Nothing was measured here yet; --from X,Y,Z --to X,Y,Z does.");
    return kDone;
  }
  for (const Measurement& one : *all) {
    std::string line = lengthText(one);
    if (one.caliper_mm) line += "; " + caliperText(one);
    if (!one.note.empty()) line += " (" + one.note + ")";
    console.say(line);
  }
  return kDone;
}

int run(const Words& words, Console& console, const Task&) {
  const fs::path folder = folderOf(words.input);
  if (words.from_mm.empty() && words.to_mm.empty() && !folder.empty()) return list(folder, console);
  if (words.from_mm.size() != 3 || words.to_mm.size() != 3) {
    return console.wrongUse({Error::Code::kInvalidInput, "A place to measure from is missing.",
                             "Give both, as --from X,Y,Z and --to X,Y,Z in mm."});
  }
  const auto model = folder.empty() ? readFile(words.input) : readFolder(folder);
  if (!model) return console.fail(model.error());
  auto measurement = measure(words, *model, console);
  if (!measurement) return console.fail(measurement.error());
  measurement->caliper_mm = words.caliper_mm;
  measurement->note = words.note;
  measurement->date = nowUtcText();
  tell(console, *measurement);
  if (folder.empty()) return kDone;
  if (const auto kept = addMeasurement(folder, *measurement); !kept) {
    return console.fail(kept.error());
  }
  if (const auto told = refreshReportPage(folder); !told) return console.fail(told.error());
  console.note("Kept in " + (folder / "measurements.json").string() + ".");
  return kDone;
}

}  // namespace

void addMeasure(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand(
      "measure", "Measure between two places of a model, or list what was measured");
  command
      ->add_option("model", words->input,
                   "A result's folder or a scan, where the measurement is kept; or a model's file")
      ->required();
  const auto place = [&](const char* name, std::vector<double>& values, const char* text) {
    return command->add_option(name, values, text)->delimiter(',')->expected(3);
  };
  place("--from", words->from_mm, "X,Y,Z in mm; the nearest place of the surface counts");
  place("--to", words->to_mm, "Likewise, the other end");
  command->add_option("--caliper", words->caliper_mm, "What a caliper shows for it, in mm")
      ->check(CLI::Range(1e-3, 1e6));
  command->add_option("--note", words->note, "What was measured, in your words");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
