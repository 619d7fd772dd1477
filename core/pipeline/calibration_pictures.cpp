// Pictures of a target that were taken before: opened, and looked through for the target.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "core/io/angles_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"
#include "core/pipeline/calibrate.h"
#include "core/pipeline/sightings.h"

namespace gyre {
namespace {

std::optional<double> angleOf(const CalibrationPictures& pictures, std::size_t i) {
  if (!pictures.angles_rad) return std::nullopt;
  return (*pictures.angles_rad)[i];
}

Result<Sightings> sightOneByOne(const CalibrationPictures& pictures, const SoughtTarget& target,
                                const CalibrationWatcher& watcher, const Task& task) {
  const std::size_t count = pictures.files.size();
  Sightings sightings(static_cast<int>(count), watcher);
  for (std::size_t i = 0; i < count; ++i) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(i) / static_cast<double>(count),
                "Picture " + std::to_string(i + 1) + " of " + std::to_string(count));
    auto read = readPicture(pictures.files[i]);
    if (!read) return read.error();
    const auto frame = std::make_shared<const Frame>(std::move(*read));
    auto view = target.find(frame->image_bgr);
    if (!view) {
      if (view.error().code == Error::Code::kCancelled) return view.error();
      sightings.missed(frame, frame->name, view.error());
      continue;
    }
    view->name = frame->name;
    view->table_angle_rad = angleOf(pictures, i);
    sightings.found(frame, std::move(*view));
  }
  return sightings;
}

// Broken files are told at once, not after all others were searched.
Result<Sightings> sightTogether(const CalibrationPictures& pictures, const SoughtTarget& target,
                                const CalibrationWatcher& watcher, const Task& task) {
  std::optional<Error> broken;
  std::vector<SeriesPicture> series;
  series.reserve(pictures.files.size());
  for (std::size_t i = 0; i < pictures.files.size(); ++i) {
    const auto open = [&broken, file = pictures.files[i]]() -> Result<cv::Mat> {
      if (broken) return *broken;
      auto read = readPicture(file);
      if (read) return read->image_bgr;
      broken = read.error();
      return read.error();
    };
    series.push_back({pictures.files[i].filename().string(), angleOf(pictures, i), open});
  }
  auto found = target.find_all(series, task);
  if (!found) return found.error();
  if (broken) return *broken;
  Sightings sightings(static_cast<int>(series.size()), watcher);
  for (std::size_t i = 0; i < found->size(); ++i) {
    Result<TargetView>& view = (*found)[i];
    if (view) {
      sightings.found(nullptr, std::move(*view));
    } else {
      sightings.missed(nullptr, series[i].name, view.error());
    }
  }
  return sightings;
}

}  // namespace

Result<CalibrationPictures> openCalibrationPictures(const std::filesystem::path& folder,
                                                    const std::filesystem::path& angles_file) {
  auto files = listPictures(folder);
  if (!files) return files.error();
  if (const auto size = commonSize(*files); !size) return size.error();
  CalibrationPictures pictures;
  if (!angles_file.empty()) {
    const auto table = readAngles(angles_file);
    if (!table) return table.error();
    auto angles_rad = anglesOfPictures(*files, *table);
    if (!angles_rad) return angles_rad.error();
    pictures.angles_rad = std::move(*angles_rad);
  }
  pictures.files = std::move(*files);
  return pictures;
}

Result<SightedPictures> sightPictures(const CalibrationPictures& pictures,
                                      const SoughtTarget& target, const SightOptions& options,
                                      const CalibrationWatcher& watcher, const Task& task) {
  const bool together = options.held == TargetHeld::kByTable && target.find_all;
  auto sightings = together ? sightTogether(pictures, target, watcher, task)
                            : sightOneByOne(pictures, target, watcher, task);
  if (!sightings) return sightings.error();
  if (const auto enough = sightings->checkEnough(options.needed); !enough) return enough.error();
  return SightedPictures{std::move(sightings->views), std::move(sightings->skipped)};
}

}  // namespace gyre
