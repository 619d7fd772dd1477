// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_store.h"

#include <stdlib.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/io/atomic_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/empty_table_file.h"
#include "core/io/file_bytes.h"
#include "core/io/free_space.h"
#include "core/io/picture_file.h"
#include "core/io/scan_settings_file.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFrames = "frames";
constexpr const char* kEmpty = "empty";
constexpr const char* kJournal = "journal.jsonl";
constexpr const char* kCalibration = "calibration.json";

// The folder as an absolute path with a name at its end, whatever way it was written.
fs::path namedFolder(const fs::path& folder) {
  std::error_code problem;
  const fs::path whole = fs::absolute(folder, problem);
  fs::path named = fs::weakly_canonical(whole, problem);
  if (problem) named = whole.lexically_normal();  // a name too long for this; making it will tell
  return named.has_filename() ? named : named.parent_path();
}

// Fills a new folder with an empty scan of the name.
Result<void> fillFolder(const fs::path& folder, const std::string& name,
                        const ScanSettings& settings, const CalibrationRecord& calibration) {
  for (const char* inner : {kFrames, kEmpty}) {
    std::error_code problem;
    fs::create_directory(folder / inner, problem);
    if (problem) return fileError(problem.value(), "create", folder / inner);
  }
  const auto text = scanSettingsText(settings);
  if (!text) return text.error();
  if (auto done = writeCalibrationRecord(folder / kCalibration, calibration); !done) return done;
  if (auto done = writeFileAtomically(folder / kJournal, ""); !done) return done;
  return writeFileAtomically(folder / (name + ".gyre"), *text);
}

// Makes a folder beside the final one, so that renaming it brings a whole scan or none.
Result<fs::path> makeFolderBeside(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder.parent_path(), problem);
  if (problem) return fileError(problem.value(), "create", folder.parent_path());
  std::string beside = (folder.parent_path() / ".gyre-new-XXXXXX").string();
  if (::mkdtemp(beside.data()) == nullptr) return fileError(errno, "create", folder);
  // mkdtemp() gives nobody else access; a scan has what any new folder has.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  static_cast<void>(::chmod(beside.c_str(), 0777 & ~mask));
  return fs::path(beside);
}

Error folderTaken(const fs::path& folder) {
  return {Error::Code::kInvalidInput,
          "The folder \"" + folder.string() + "\" exists already and is not empty.",
          "Choose another name, or continue the scan that is in it."};
}

// A PNG ends with the IEND chunk: without it, the file is not the one that addView() synced.
bool isWholePng(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  std::array<char, 8> tail{};
  if (!stream || stream.tellg() < std::streamoff{57}) return false;  // shorter than any PNG
  stream.seekg(-8, std::ios::end);
  stream.read(tail.data(), tail.size());
  return stream && std::string_view(tail.data(), 4) == "IEND";
}

std::string nowUtc() {
  std::timespec now{};
  std::timespec_get(&now, TIME_UTC);
  std::tm parts{};
  ::gmtime_r(&now.tv_sec, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return std::string(text.data(), length) + formatted(".%03ldZ", now.tv_nsec / 1'000'000 % 1000);
}

}  // namespace

std::string viewFileName(int view) { return formatted("view_%04d.png", view); }

Result<ScanStore> ScanStore::create(const fs::path& folder, const ScanSettings& settings,
                                    const CalibrationRecord& calibration) {
  const fs::path named = namedFolder(folder);
  std::error_code problem;
  if (fs::exists(named, problem) && !(fs::is_directory(named) && fs::is_empty(named, problem))) {
    return folderTaken(folder);
  }
  const CameraModel& camera = calibration.calibration.camera;
  const auto wanted = bytesForScan(settings.views, {camera.width_px, camera.height_px});
  if (auto room = checkFreeSpace(named, wanted); !room) return room.error();
  const auto beside = makeFolderBeside(named);
  if (!beside) return beside.error();
  const std::string name = named.filename().string();
  auto done = fillFolder(*beside, name, settings, calibration);
  // Renaming over an empty folder replaces it; over any other it fails, whoever filled it
  // meanwhile.
  if (done && ::rename(beside->c_str(), named.c_str()) != 0) {
    done = errno == ENOTEMPTY || errno == EEXIST || errno == ENOTDIR
               ? folderTaken(folder)
               : fileError(errno, "create", folder);
  }
  if (!done) {
    fs::remove_all(*beside, problem);
    return done.error();
  }
  if (auto synced = syncFolder(named.parent_path()); !synced) return synced.error();
  return open(named);
}

Result<ScanStore> ScanStore::open(const fs::path& folder_or_file) {
  const fs::path named = namedFolder(folder_or_file);
  std::error_code problem;
  const bool is_file = fs::is_regular_file(named, problem);
  const fs::path folder = is_file ? named.parent_path() : named;
  const auto file = is_file ? Result<fs::path>(named) : scanSettingsFileIn(folder);
  if (!file) return file.error();
  auto settings = readScanSettings(*file);
  if (!settings) return settings.error();
  auto calibration = readCalibrationRecord(folder / kCalibration);
  if (!calibration) return calibration.error();
  auto journal = ScanJournal::open(folder / kJournal);
  if (!journal) return journal.error();
  ScanStore store(*std::move(journal));
  store.folder_ = folder;
  store.settings_ = *std::move(settings);
  store.record_ = *std::move(calibration);
  store.remarks_ = store.journal_.remarks();
  for (const CapturedView& view : store.journal_.views()) {
    if (view.view >= store.settings_.views) continue;
    if (isWholePng(folder / kFrames / view.file)) store.views_.push_back(view);
  }
  // Now that the lock is ours, nobody else is writing here.
  for (const fs::path& inner : {folder, folder / kFrames, folder / kEmpty}) {
    removeUnfinishedFiles(inner);
  }
  return store;
}

bool ScanStore::complete() const {
  return views_.size() == static_cast<std::size_t>(settings_.views);
}

Result<void> ScanStore::addView(const Frame& frame, std::int64_t steps, double sharpness) {
  GYRE_CHECK(frame.view >= 0 && frame.view < settings_.views);
  CapturedView view;
  view.view = frame.view;
  view.file = viewFileName(frame.view);
  view.table_angle_rad = frame.table_angle_rad;
  view.steps = steps;
  view.sharpness = sharpness;
  view.time_utc = nowUtc();
  // The picture first: a line in the journal promises that its picture is on the disk.
  if (auto done = writePicture(folder_ / kFrames / view.file, frame.image_bgr); !done) return done;
  if (auto done = journal_.append(view); !done) return done;
  const auto place = std::lower_bound(
      views_.begin(), views_.end(), view.view,
      [](const CapturedView& captured, int number) { return captured.view < number; });
  if (place != views_.end() && place->view == view.view) {
    *place = std::move(view);
  } else {
    views_.insert(place, std::move(view));
  }
  return {};
}

Result<void> ScanStore::addRemark(int view, const std::string& text) {
  ScanRemark remark{view, text, nowUtc()};
  if (auto done = journal_.append(remark); !done) return done;
  remarks_.push_back(std::move(remark));
  return {};
}

Result<void> ScanStore::addEmptyTable(const Frame& frame) {
  return writeEmptyTable(folder_ / kEmpty, frame);
}

Result<FramePtr> ScanStore::readView(const CapturedView& view) const {
  auto frame = readPicture(folder_ / kFrames / view.file);
  if (!frame) return frame.error();
  frame->view = view.view;
  frame->table_angle_rad = view.table_angle_rad;
  return std::make_shared<const Frame>(*std::move(frame));
}

Result<FramePtr> ScanStore::readEmptyTable() const {
  return gyre::readEmptyTable(folder_ / kEmpty);
}

}  // namespace gyre
