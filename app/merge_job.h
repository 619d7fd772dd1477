// Merges passes of one object for the window: which they are, where the result goes, and the job.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/scan_session.h"
#include "core/base/result.h"
#include "core/base/task.h"

namespace gyre {

// The scans that a result was merged from, or the result itself, which is one.
std::vector<std::filesystem::path> passesOf(const std::filesystem::path& result);

// The same of several results, in their order.
std::vector<std::filesystem::path> passesOf(const std::vector<std::filesystem::path>& results);

// "duck-pass3" beside "duck", the first of two passes: a folder that is not there yet.
std::filesystem::path nextPassFolder(const std::vector<std::filesystem::path>& passes);

struct MergedModel {
  OpenedModel model;             // as it is opened again
  std::optional<Error> problem;  // no surface could be made: shown beside the points
};

// Merges what the results are made of, in this order, into a new folder beside the first pass, such
// as "duck-merged". Each may itself be merged. The passes are only read. When merging fails, or is
// stopped in its middle, no folder is left. Any thread.
Result<MergedModel> mergeResults(const std::vector<std::filesystem::path>& results,
                                 const Task& task);

}  // namespace gyre
