// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/calibration_run.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <utility>

#include "app/sim_target.h"
#include "core/calib/lens/calibrate_hand_held.h"
#include "core/calib/targets/ruler_scale.h"
#include "core/io/calibration_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"
#include "core/io/points_file.h"
#include "core/pipeline/target_finder.h"
#include "core/scan/picture_size.h"

namespace gyre {
namespace {

// A caliper shows hundredths; marks of ink are a tenth wide, and are met to half of that.
constexpr double kCaliperSigma_mm = 0.05;
constexpr std::size_t kLeastHandHeld = 3;
constexpr std::size_t kLeastChecked = 6;

// "1280x960"; nothing for an empty text.
Result<std::optional<Eigen::Vector2i>> imageSizeIn(const std::string& text) {
  if (text.empty()) return std::optional<Eigen::Vector2i>();
  Eigen::Vector2i size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.x());
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.y());
    if (height.ec == std::errc{} && height.ptr == end && size.minCoeff() > 0) {
      return std::optional<Eigen::Vector2i>(size);
    }
  }
  return Error{Error::Code::kInvalidInput, "\"" + text + "\" is not the size of a picture.",
               "Write width x height in pixels, such as --image-size 1280x960."};
}

Result<Target> targetAtSize(const CalibrationWords& words) {
  auto target = findTarget(words.target);
  if (!target || !words.ruler_right_mm || !words.ruler_down_mm) return target;
  RulerReading reading;
  reading.right_mm = *words.ruler_right_mm;
  reading.down_mm = *words.ruler_down_mm;
  return scaledByRulers(*target, reading);
}

// A target without corners is a set of markers glued around the platter; one without page axes was
// not folded from paper.
TargetShape shapeOf(const Target& target) {
  if (target.corners.empty()) return TargetShape::kLooseMarkers;
  return target.page_axes.empty() ? TargetShape::kExact : TargetShape::kFreeFaces;
}

bool liesFlat(const Target& target) {
  constexpr double kFlat_mm = 1.0;
  const auto points = pointsOf(target);
  return std::all_of(points.begin(), points.end(), [](const TargetPoint& point) {
    return std::abs(point.position_in_target.z()) < kFlat_mm;
  });
}

}  // namespace

Result<CalibrateOptions> optionsFor(const Target& target, bool rulers_measured,
                                    const std::optional<CameraModel>& lens) {
  if (!lens && liesFlat(target)) {
    return Error{Error::Code::kInvalidInput,
                 "The target \"" + target.name +
                     "\" lies flat: turned about its own normal it cannot show the lens.",
                 "Use the wedge or a cube; or, when only the camera was moved, keep the lens of a "
                 "calibration (--intrinsics FILE)."};
  }
  CalibrateOptions options;
  options.bundle.shape = shapeOf(target);
  options.bundle.fixed_camera = lens;
  if (rulers_measured) options.bundle.caliper_sigma_mm = kCaliperSigma_mm;
  return options;
}

Result<CalibrationSetup> calibrationSetup(const CalibrationWords& words) {
  auto target = targetAtSize(words);
  if (!target) return target.error();
  std::optional<CameraModel> lens;
  if (!words.intrinsics.empty()) {
    const auto known = readCalibration(words.intrinsics);
    if (!known) return known.error();
    lens = known->camera;
  }
  auto options = optionsFor(*target, words.ruler_right_mm.has_value(), lens);
  if (!options) return options.error();
  CalibrationSetup setup;
  setup.options = std::move(*options);
  setup.options.bundle.object_size_mm = words.object_size_mm;
  setup.options.bundle.object_middle_in_table = {0.0, 0.0, 0.5 * words.object_size_mm};
  FindTargetOptions start;
  start.camera = lens;
  setup.target = soughtTarget(*target, start);
  return setup;
}

Result<CalibrationRecord> calibrateFromPointsFile(const std::filesystem::path& file,
                                                  const std::string& image_size, PointsMode mode,
                                                  const Task& task) {
  const auto size = imageSizeIn(image_size);
  if (!size) return size.error();
  const auto points = readPoints(file);
  if (!points) return points.error();
  PointsOptions options;
  options.image_size_px = *size;
  options.mode = mode;
  auto calibrated = calibratePoints(*points, options, task);
  if (!calibrated) return calibrated.error();
  CalibrationRecord record;
  record.calibration = std::move(calibrated->calibration);
  record.report = std::move(calibrated->report);
  record.date = nowUtcText();
  record.target = file.filename().string();
  return record;
}

Result<CalibrationRecord> calibrateHandHeldSet(const std::filesystem::path& folder,
                                               const CalibrationWords& words,
                                               const CalibrationWatcher& watcher,
                                               const Task& task) {
  const auto target = targetAtSize(words);
  if (!target) return target.error();
  const auto pictures = openCalibrationPictures(folder, {});
  if (!pictures) return pictures.error();
  const auto size = commonSize(pictures->files);
  if (!size) return size.error();
  const auto sighted =
      sightPictures(*pictures, soughtTarget(*target), {TargetHeld::kByHand, kLeastHandHeld},
                    watcher, task.part(0.0, 0.8));
  if (!sighted) return sighted.error();
  auto calibrated = calibrateHandHeld(*target, sighted->views, {size->width_px, size->height_px},
                                      {}, task.part(0.8, 1.0));
  if (!calibrated) return calibrated.error();
  CalibrationRecord record;
  record.calibration = std::move(calibrated->calibration);
  record.report = std::move(calibrated->report);
  record.date = nowUtcText();
  record.target = target->name;
  return record;
}

Result<CalibrationCheck> checkByPictures(const std::filesystem::path& calibration,
                                         const CalibrationPictures& pictures,
                                         const CalibrationWords& words,
                                         const CalibrationWatcher& watcher, const Task& task) {
  const auto known = readCalibration(calibration);
  if (!known) return known.error();
  const auto target = targetAtSize(words);
  if (!target) return target.error();
  const auto size = commonSize(pictures.files);
  if (!size) return size.error();
  if (const auto same = checkCalibratedSize(*size, known->camera, "The pictures have"); !same) {
    return same.error();
  }
  const auto sighted =
      sightPictures(pictures, soughtTarget(*target), {TargetHeld::kByTable, kLeastChecked}, watcher,
                    task.part(0.0, 0.9));
  if (!sighted) return sighted.error();
  return checkCalibration(*known, sighted->views, *target, task.part(0.9, 1.0));
}

std::filesystem::path referenceFor(const std::filesystem::path& calibration_file) {
  std::filesystem::path picture = calibration_file;
  return picture.replace_extension(".png");
}

Result<void> keepReference(const std::filesystem::path& calibration_file,
                           const CalibrationOutcome& outcome) {
  if (!outcome.reference) return {};
  return writePicture(referenceFor(calibration_file), outcome.reference->image_bgr);
}

std::string nowUtcText() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace gyre
