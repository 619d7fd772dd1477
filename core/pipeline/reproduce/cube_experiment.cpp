// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reproduce/cube_experiment.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/pipeline/reproduce/cube_run.h"

namespace gyre {
namespace {

using Row = std::vector<std::optional<double>>;

// Where the columns stand; four of each way follow.
enum Column : std::size_t { kRun, kViews, kFirstWay };
constexpr std::size_t kColumnsOfWay = 4;

// As its text says: "about 1 %", of which calibration "accounts for about 70 %".
constexpr double kPaperError_percent = 1.0;
constexpr double kPaperCalibration_percent = 0.7;

ExperimentTable emptyTable() {
  ExperimentTable table;
  table.name = "table3";
  table.caption =
      "Errors of the corners of a paper cube of 100 mm on the simulated rig, calibrated on the "
      "same "
      "cube. Calibration error: mean distance of a point from its rays; reconstruction error: from "
      "the true corner. The paper's way calibrates from one picture and believes the commanded "
      "angles; placed by hand: the cube stands 0.5 mm and 0.2 deg off where it is thought to be. "
      "Gyre calibrates from 24 pictures of a turn and solves the angles. The paper found about 1 % "
      "in all, 70 % of it from calibration. Rows without a run are the mean of the runs.";
  table.columns = {{"run", "run"}, {"views", "views"}};
  const struct {
    const char* key;
    const char* label;
  } ways[] = {
      {"one_picture", "one picture"}, {"by_hand", "placed by hand"}, {"whole_turn", "whole turn"}};
  for (std::size_t way = 0; way < kCubeWays.size(); ++way) {
    const std::string key = ways[way].key;
    const std::string label = ways[way].label;
    table.columns.push_back({key + "_calibration_mm", label + ": calibration error"});
    table.columns.push_back({key + "_error_mm", label + ": reconstruction error"});
    table.columns.push_back({key + "_calibration_percent", label + ": calibration error [%]"});
    table.columns.push_back({key + "_error_percent", label + ": reconstruction error [%]"});
    table.drawing.measured.push_back(kFirstWay + kColumnsOfWay * way + 1);
    table.drawing.compared.push_back(kFirstWay + kColumnsOfWay * way);
  }
  table.columns.push_back({"paper_calibration_percent", "the paper's calibration error [%]"});
  table.columns.push_back({"paper_error_percent", "the paper's reconstruction error [%]"});
  table.drawing.across = kViews;
  table.drawing.panels_by = kRun;
  table.drawing.across_label = "views, 1.8° apart";
  table.drawing.up_label = "mean error of a corner [mm]";
  return table;
}

// mm and, for a cube of 100 mm, the same number in %.
void addWay(const CubeError& error, Row& row) {
  if (error.corners == 0) {
    row.insert(row.end(), kColumnsOfWay, std::nullopt);
    return;
  }
  for (int i = 0; i < 2; ++i) {
    row.emplace_back(error.calibration_mm);
    row.emplace_back(error.reconstruction_mm);
  }
}

// A column in which a run has no number has no mean.
Row meanOf(const std::vector<Row>& rows, int views) {
  Row mean = {std::nullopt, static_cast<double>(views)};
  for (std::size_t column = kFirstWay; column < rows.front().size(); ++column) {
    std::optional<double> sum = 0.0;
    int count = 0;
    for (const Row& row : rows) {
      if (row[kViews] != mean[kViews]) continue;
      ++count;
      sum = sum && row[column] ? std::optional(*sum + *row[column]) : std::nullopt;
    }
    mean.push_back(sum ? std::optional(*sum / count) : std::nullopt);
  }
  return mean;
}

Result<void> addRun(const CubeExperimentOptions& options, int run, const Task& task,
                    ExperimentTable& table) {
  RigSettings rig;
  rig.object = "target";
  rig.target = "cube";
  rig.seed = options.seed + run;
  const int most = *std::max_element(options.views.begin(), options.views.end());
  const auto cube = CubeRun::make(atImageWidth(rig, options.image_width_px), most, task);
  if (!cube) return cube.error();
  std::vector<Row> rows;
  for (const int views : options.views) {
    rows.push_back({static_cast<double>(run + 1), static_cast<double>(views)});
  }
  for (const CubeWay way : kCubeWays) {
    const auto calibration = cube->calibrate(way, Task(task.stopToken()));
    if (!calibration) return calibration.error();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      addWay(cube->measure(*calibration, way, options.views[i]), rows[i]);
    }
  }
  for (Row& row : rows) {
    row.insert(row.end(), {kPaperCalibration_percent, kPaperError_percent});
  }
  std::move(rows.begin(), rows.end(), std::back_inserter(table.rows));
  return {};
}

}  // namespace

Result<ExperimentTable> cubeExperiment(const CubeExperimentOptions& options, const Task& task) {
  const bool sane = options.runs >= 1 && !options.views.empty() &&
                    *std::min_element(options.views.begin(), options.views.end()) >= 3;
  if (!sane) {
    return Error{Error::Code::kInvalidInput, "The experiment has no run or too few views.",
                 "Give at least one run and at least three views."};
  }
  ExperimentTable table = emptyTable();
  for (int run = 0; run < options.runs; ++run) {
    const Task part = task.part(static_cast<double>(run) / options.runs,
                                static_cast<double>(run + 1) / options.runs);
    if (auto added = addRun(options, run, part, table); !added) return added.error();
  }
  const std::vector<Row> runs = table.rows;
  for (const int views : options.views) table.rows.push_back(meanOf(runs, views));
  task.report(1.0, "Table ready");
  return table;
}

}  // namespace gyre
