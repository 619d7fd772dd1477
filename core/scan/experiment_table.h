// What an experiment found: a table of numbers, and how it is drawn.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gyre {

// key: its name in files, with the unit ("two_view_mm"). label: in a few words for people.
struct ExperimentColumn {
  std::string key;
  std::string label;
};

// One curve a column, one panel for each value of a column. Indices into the table's columns.
struct ExperimentDrawing {
  std::size_t across = 0;             // what is told along the panel
  std::size_t panels_by = 0;          // what tells the panels apart
  std::vector<std::size_t> measured;  // curves with marks
  std::vector<std::size_t> compared;  // dashed lines: bounds, and what others printed
  std::string across_label;           // "views"
  std::string up_label;               // "mean error [mm]"
};

struct ExperimentTable {
  std::string name;     // of its files, without an ending: "table1"
  std::string caption;  // what was done, in sentences
  std::vector<ExperimentColumn> columns;
  std::vector<std::vector<std::optional<double>>> rows;  // an empty cell was not measured
  ExperimentDrawing drawing;
};

}  // namespace gyre
