// An experiment's table as files that other programs read, and as a picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/scan/experiment_table.h"

namespace gyre {

// A line of keys, then a line a row; an empty cell is empty.
std::string csvOf(const ExperimentTable& table);

// {name, caption, columns: {key: label}, rows: [{key: number or null}]}
std::string jsonOf(const ExperimentTable& table);

// Both axes logarithmic: errors fall by powers of the number of views. Cells that are empty, zero
// or negative are left out.
std::string svgOf(const ExperimentTable& table);

// NAME.csv, NAME.json and NAME.svg into the folder, which is made. Each is whole or not there.
Result<void> writeExperiment(const std::filesystem::path& folder, const ExperimentTable& table);

}  // namespace gyre
