// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/find_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/io/frame_folder.h"
#include "core/pipeline/model_scale.h"
#include "core/recover/rough_turntable.h"

namespace gyre {
namespace {

constexpr double kMeets = 0.3;

// Matches of views so many apart; angle-less pictures count steps.
void add(const std::vector<std::vector<PixelMatch>>& pairs, std::size_t apart,
         const PreparedPictures& prepared, std::vector<TurnedMatch>& all) {
  const std::vector<PictureView>& views = prepared.views;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double turn = prepared.angles_told
                            ? views[i + apart].table_angle_rad - views[i].table_angle_rad
                            : static_cast<double>(apart);
    for (const PixelMatch& each : pairs[i]) all.push_back({each.first, each.second, turn});
  }
}

// The last picture shows of the first what neighbours show of each other, or nearly.
bool meetsItsStart(const MatchedPictures& matched) {
  std::vector<double> counts;
  counts.reserve(matched.pairs.size());
  for (const auto& pair : matched.pairs) counts.push_back(static_cast<double>(pair.size()));
  return !counts.empty() &&
         static_cast<double>(matched.closing.size()) > kMeets * median(std::move(counts));
}

Error noWholeTurn() {
  return {Error::Code::kTooFew,
          "The last picture does not meet the first, and nothing tells how far the table turned.",
          "Take pictures of one whole turn in even steps, or name the step, --step-deg 10, or the "
          "calibration."};
}

}  // namespace

Result<std::size_t> findCamera(PreparedPictures& prepared, const MatchedPictures& matched,
                               const Task& task) {
  const std::vector<PictureView>& views = prepared.views;
  if (!prepared.angles_told && !meetsItsStart(matched)) return noWholeTurn();
  std::vector<std::filesystem::path> files;
  files.reserve(views.size());
  for (const PictureView& view : views) files.push_back(view.file);
  const auto size = commonSize(files);
  if (!size) return size.error();
  std::vector<TurnedMatch> matches;
  add(matched.apart(), matched.stride, prepared, matches);
  RoughTurntableOptions options;
  options.width_px = size->width_px;
  options.height_px = size->height_px;
  options.angles_known = prepared.angles_told;
  options.step_rad = 2.0 * std::numbers::pi / static_cast<double>(views.size());
  auto rough = roughTurntable(matches, options, task);
  if (!rough) return rough.error();
  CalibrationRecord record(std::move(rough->calibration));
  scaleCalibration(record.calibration, placementOf(rough->spots_in_table), kUnknownSize_mm);
  prepared.calibration = std::move(record);
  return rough->agreeing;
}

Result<void> turnCamera(PreparedPictures& prepared, const MatchedPictures& matched,
                        const Task& task) {
  std::vector<TurnedMatch> matches;
  add(matched.apart(), matched.stride, prepared, matches);
  auto turned = turnedCalibration(matches, prepared.calibration.calibration,
                                  RoughTurntableOptions{}.tolerance_px, task);
  if (!turned) return turned.error();
  prepared.calibration.calibration = std::move(*turned);
  return {};
}

}  // namespace gyre
