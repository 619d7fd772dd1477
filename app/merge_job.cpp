// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/merge_job.h"

#include <system_error>
#include <utility>

#include "app/calibration_run.h"
#include "app/version.h"
#include "core/io/passes_file.h"
#include "core/pipeline/merge/merge_passes.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr double kMergingShare = 0.95;  // of the time; the rest reads what was written

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// The result's folder, without a slash at its end or a .gyre file in it.
fs::path folderOf(const fs::path& result) {
  fs::path folder = fs::absolute(result).lexically_normal();
  if (folder.extension() == ".gyre" || !folder.has_filename()) folder = folder.parent_path();
  return folder;
}

fs::path beside(const fs::path& folder, const std::string& ending) {
  return folder.parent_path() / (folder.filename().string() + ending);
}

fs::path mergedFolder(const fs::path& first) {
  fs::path out = beside(first, "-merged");
  for (int number = 2; isThere(out); ++number) {
    out = beside(first, "-merged-" + std::to_string(number));
  }
  return out;
}

}  // namespace

std::vector<fs::path> passesOf(const fs::path& result) {
  const fs::path folder = folderOf(result);
  std::vector<fs::path> folders;
  if (isThere(folder / kPassesFile)) {
    if (const auto passes = readPasses(folder / kPassesFile)) {
      for (const ScanPass& pass : *passes) folders.push_back(pass.folder);
    }
  }
  if (folders.empty()) folders.push_back(folder);
  return folders;
}

std::vector<fs::path> passesOf(const std::vector<fs::path>& results) {
  std::vector<fs::path> passes;
  for (const fs::path& result : results) {
    for (fs::path& pass : passesOf(result)) passes.push_back(std::move(pass));
  }
  return passes;
}

fs::path nextPassFolder(const std::vector<fs::path>& passes) {
  std::size_t number = passes.size() + 1;
  while (isThere(beside(passes.front(), "-pass" + std::to_string(number)))) ++number;
  return beside(passes.front(), "-pass" + std::to_string(number));
}

Result<MergedModel> mergeResults(const std::vector<fs::path>& results, const Task& task) {
  MergeRequest request;
  request.passes = passesOf(results);
  request.out = mergedFolder(request.passes.front());
  request.report.date = nowUtcText();
  request.report.versions["Gyre"] = programVersion();
  const auto merged = mergePasses(request, task.part(0.0, kMergingShare));
  if (!merged) {
    std::error_code ignored;
    fs::remove_all(request.out, ignored);  // half a result would look like a whole one
    return merged.error();
  }
  auto model = openScanOrModel(request.out, task.part(kMergingShare, 1.0));
  if (!model) return model.error();
  return MergedModel{std::move(model).value(), merged->mesh_problem};
}

}  // namespace gyre
