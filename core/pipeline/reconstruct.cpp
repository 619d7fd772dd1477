// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>
#include <utility>

#include <opencv2/core.hpp>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/empty_table_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"
#include "core/io/scan_store.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

// Views closer than this are the same stop of the table.
constexpr double kSameAngle_rad = 1e-6;
// Until the steps are found this keeps the views in order.
constexpr double kInOrder_rad = 1e-3;

Error invalid(std::string what, std::string advice) {
  return {Error::Code::kInvalidInput, std::move(what), std::move(advice)};
}

bool isDirectory(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

bool isScan(const fs::path& path) {
  std::error_code problem;
  if (path.extension() == ".gyre") return true;
  for (fs::directory_iterator entry(path, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (entry->path().extension() == ".gyre") return true;
  }
  return false;
}

// A scan's own views, calibration and empty table.
Result<PreparedPictures> openScan(const fs::path& path) {
  auto store = ScanStore::open(path);
  if (!store) return store.error();
  PreparedPictures prepared;
  prepared.calibration = store->calibrationRecord();
  if (auto empty = store->readEmptyTable()) {
    prepared.empty_table = *empty;
  } else if (empty.error().code != Error::Code::kNotFound) {
    return empty.error();
  }
  for (const CapturedView& view : store->views()) {
    prepared.views.push_back(
        {view.file, store->folder() / "frames" / view.file, {}, view.table_angle_rad});
  }
  return prepared;
}

Result<PreparedPictures> openFolder(const PictureSet& set) {
  auto files = listPictures(set.pictures);
  if (!files) return files.error();
  PreparedPictures prepared;
  for (fs::path& file : *files) {
    std::string name = file.filename().string();
    prepared.views.push_back({std::move(name), std::move(file), {}, 0.0});
  }
  return prepared;
}

Result<void> applyAngles(const PictureSet& set, PreparedPictures& prepared) {
  if (!set.angles.empty()) {
    const auto table = readAngles(set.angles);
    if (!table) return table.error();
    std::vector<fs::path> files;
    for (const PictureView& view : prepared.views) files.push_back(view.file);
    const auto angles = anglesOfPictures(files, *table);
    if (!angles) return angles.error();
    for (std::size_t i = 0; i < files.size(); ++i) prepared.views[i].table_angle_rad = (*angles)[i];
  } else if (set.step_rad || !prepared.angles_told) {
    const double step_rad = set.step_rad.value_or(kInOrder_rad);
    for (std::size_t i = 0; i < prepared.views.size(); ++i) {
      prepared.views[i].table_angle_rad = static_cast<double>(i) * step_rad;
    }
  }
  return {};
}

// Sorts the views by angle and refuses a table that does not turn.
Result<void> orderViews(std::vector<PictureView>& views) {
  if (views.size() < 3) {
    return invalid("There are only " + std::to_string(views.size()) + " pictures to measure from.",
                   "Give at least three, better dozens, of one turn of the table.");
  }
  std::stable_sort(views.begin(), views.end(), [](const PictureView& a, const PictureView& b) {
    return a.table_angle_rad < b.table_angle_rad;
  });
  if (views.back().table_angle_rad - views.front().table_angle_rad < kSameAngle_rad) {
    return invalid("All pictures have the same table angle.",
                   "Without turning there is no depth: check the angles.");
  }
  return {};
}

Result<void> checkSizes(const PreparedPictures& prepared) {
  std::vector<fs::path> files;
  for (const PictureView& view : prepared.views) files.push_back(view.file);
  const auto size = commonSize(files);
  if (!size) return size.error();
  return checkCalibratedSize(*size, prepared.calibration.calibration.camera, "The pictures have");
}

void findMasks(const fs::path& folder, std::vector<PictureView>& views) {
  for (PictureView& view : views) {
    fs::path mask = maskFor(view.file, folder);
    if (std::error_code none; fs::exists(mask, none)) view.mask = std::move(mask);
  }
}

}  // namespace

Result<PreparedPictures> preparePictures(const PictureSet& set) {
  auto prepared = isScan(set.pictures) ? openScan(set.pictures) : openFolder(set);
  if (!prepared) return prepared;
  if (!set.calibration.empty()) {
    auto calibration = readCalibrationRecord(set.calibration);
    if (!calibration) return calibration.error();
    prepared->calibration = std::move(*calibration);
  }
  const bool calibrated = isScan(set.pictures) || !set.calibration.empty();
  if (calibrated && !prepared->calibration.calibration.cam_from_table) {
    return invalid("The calibration does not say where the table is.",
                   "Calibrate with the target on the turning table.");
  }
  const bool named = !set.angles.empty() || set.step_rad.has_value();
  prepared->angles_told = named || (isScan(set.pictures) && !set.find_steps);
  if (auto applied = applyAngles(set, *prepared); !applied) return applied.error();
  if (auto ordered = orderViews(prepared->views); !ordered) return ordered.error();
  if (calibrated) {
    if (auto sized = checkSizes(*prepared); !sized) return sized.error();
  }
  if (!set.background.empty()) {
    auto background = readEmptyTable(set.background);
    if (!background) return background.error();
    prepared->empty_table = *background;
  }
  if (!set.masks.empty()) {
    if (!isDirectory(set.masks)) {
      return Error{Error::Code::kNotFound, "There is no folder " + set.masks.string() + ".",
                   "Name the folder that holds the masks."};
    }
    findMasks(set.masks, prepared->views);
  }
  return prepared;
}

Result<Reconstruction> reconstruct(const PreparedPictures& prepared,
                                   const ReconstructOptions& options,
                                   const TrackedFrameHandler& on_frame, const Task& task) {
  auto live = LiveReconstruction::create(prepared.calibration, prepared.empty_table, options);
  if (!live) return live.error();
  const Task views_task = task.part(0.0, 0.95);
  double reading_s = 0.0;
  const std::size_t count = prepared.views.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (task.stopRequested()) return cancelled();
    const PictureView& view = prepared.views[i];
    views_task.report(static_cast<double>(i) / static_cast<double>(count),
                      "View " + std::to_string(i + 1) + " of " + std::to_string(count));
    const double start_s = steadySeconds();
    auto read = readPicture(view.file);
    if (!read) return read.error();
    cv::Mat mask;
    if (!view.mask.empty()) {
      auto mask_read = readMask(view.mask);
      if (!mask_read) return mask_read.error();
      mask = std::move(*mask_read);
      if (mask.size() != read->image_bgr.size()) {
        return invalid(
            "The mask " + view.mask.filename().string() + " has another size than its picture.",
            "Make masks of the pictures' own size.");
      }
    }
    reading_s += steadySeconds() - start_s;
    read->view = static_cast<int>(i);
    read->table_angle_rad = view.table_angle_rad;
    auto tracked = live->addFrame(std::make_shared<const Frame>(std::move(*read)), mask);
    if (!tracked) return tracked.error();
    if (on_frame) on_frame(*tracked);
  }
  auto result = live->finish(task.part(0.95, 1.0));
  if (result) result->seconds["read"] = reading_s;
  return result;
}

}  // namespace gyre
