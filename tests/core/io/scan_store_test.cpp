// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <opencv2/core.hpp>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Calibration someCalibration() {
  Calibration calibration;
  calibration.camera.width_px = 32;
  calibration.camera.height_px = 24;
  calibration.camera.fx = calibration.camera.fy = 100.0;
  return calibration;
}

ScanSettings settingsFor(int views) {
  ScanSettings settings;
  settings.title = "Duck";
  settings.views = views;
  return settings;
}

Frame frameOf(int view) {
  Frame frame;
  frame.view = view;
  frame.table_angle_rad = 0.1 + view / 3.0;
  frame.image_bgr = cv::Mat(24, 32, CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(view) + 1);
  random.fill(frame.image_bgr, cv::RNG::UNIFORM, 0, 256);
  return frame;
}

bool showsView(const ScanStore& store, const CapturedView& view) {
  const auto frame = store.readView(view);
  return frame && (*frame)->view == view.view &&
         (*frame)->table_angle_rad == frameOf(view.view).table_angle_rad &&
         cv::norm((*frame)->image_bgr, frameOf(view.view).image_bgr, cv::NORM_INF) == 0.0;
}

std::vector<int> numbersOf(const ScanStore& store) {
  std::vector<int> numbers;
  for (const CapturedView& view : store.views()) numbers.push_back(view.view);
  return numbers;
}

// A scan in the folder, with these views, closed again.
void makeScan(const std::filesystem::path& folder, int views, const std::vector<int>& captured) {
  auto store = ScanStore::create(folder, settingsFor(views), someCalibration());
  ASSERT_TRUE(store) << store.error().sentence();
  for (const int view : captured) ASSERT_TRUE(store->addView(frameOf(view), 16 * view, 2.5));
}

TEST(ScanStore, GivesBackWhatWasPutIn) {
  const TempDir dir;
  makeScan(dir / "Ente ä 猫", 3, {0, 2, 1});
  const auto store = ScanStore::open((dir / "Ente ä 猫").string() + "/");
  ASSERT_TRUE(store) << store.error().sentence();
  EXPECT_THAT(numbersOf(*store), ElementsAre(0, 1, 2));
  EXPECT_TRUE(store->complete());
  EXPECT_EQ(store->settings().title, "Duck");
  EXPECT_EQ(store->calibration().camera.fx, 100.0);
  EXPECT_EQ(store->views()[2].steps, 32);
  EXPECT_EQ(store->views()[2].sharpness, 2.5);
  EXPECT_THAT(store->views()[2].time_utc, testing::MatchesRegex("20..-..-..T..:..:..\\....Z"));
  for (const CapturedView& view : store->views()) EXPECT_TRUE(showsView(*store, view));
}

TEST(ScanStore, OpensByItsFileAndAfterItsFolderWasRenamed) {
  const TempDir dir;
  makeScan(dir / "duck", 2, {0});
  EXPECT_TRUE(ScanStore::open(dir / "duck" / "duck.gyre"));
  std::filesystem::rename(dir / "duck", dir / "goose");
  const auto store = ScanStore::open(dir / "goose");
  ASSERT_TRUE(store) << store.error().sentence();
  EXPECT_THAT(numbersOf(*store), ElementsAre(0));
  EXPECT_FALSE(store->complete());
}

TEST(ScanStore, ReplacesAViewThatIsTakenAgain) {
  const TempDir dir;
  makeScan(dir / "duck", 2, {0, 0});
  EXPECT_THAT(numbersOf(*ScanStore::open(dir / "duck")), ElementsAre(0));
}

TEST(ScanStore, KeepsAllThatTheCalibrationKnows) {
  const TempDir dir;
  CalibrationRecord record(someCalibration());
  record.target = "ring";
  record.table_from_target = Rigid3{};
  record.table_from_target->translation = {1.0, -2.0, 0.0};
  record.points_in_target = {{3.0, 4.0, 5.0}};
  ASSERT_TRUE(ScanStore::create(dir / "duck", settingsFor(2), record));
  const auto store = ScanStore::open(dir / "duck");
  ASSERT_TRUE(store) << store.error().sentence();
  EXPECT_EQ(store->calibrationRecord().target, "ring");
  EXPECT_EQ(store->calibrationRecord().table_from_target->translation.y(), -2.0);
  EXPECT_EQ(store->calibrationRecord().points_in_target, record.points_in_target);
}

TEST(ScanStore, KeepsTheEmptyTable) {
  const TempDir dir;
  auto store = ScanStore::create(dir / "duck", settingsFor(2), someCalibration());
  ASSERT_TRUE(store) << store.error().sentence();
  EXPECT_EQ(store->readEmptyTable().error().code, Error::Code::kNotFound);
  Frame frame = frameOf(7);
  frame.table_angle_rad = -0.35;
  ASSERT_TRUE(store->addEmptyTable(frame));
  const auto read = store->readEmptyTable();
  ASSERT_TRUE(read) << read.error().sentence();
  EXPECT_EQ(cv::norm((*read)->image_bgr, frame.image_bgr, cv::NORM_INF), 0);
  EXPECT_NEAR((*read)->table_angle_rad, -0.35, 1e-12);
}

TEST(ScanStore, CreatesInAnEmptyFolderAndMakesTheFoldersAbove) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "empty");
  EXPECT_TRUE(ScanStore::create(dir / "empty", settingsFor(2), someCalibration()));
  EXPECT_TRUE(ScanStore::create(dir / "a/b/c", settingsFor(2), someCalibration()));
}

TEST(ScanStore, TouchesNothingInAFolderThatIsNotEmpty) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "photos");
  putFile(dir / "photos" / "aunt.jpg", "aunt");
  const auto store = ScanStore::create(dir / "photos", settingsFor(2), someCalibration());
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, Error::Code::kInvalidInput);
  EXPECT_FALSE(ScanStore::create(putFile(dir / "file", "x"), settingsFor(2), someCalibration()));
  EXPECT_EQ(std::distance(std::filesystem::recursive_directory_iterator(dir.path()), {}), 3);
}

TEST(ScanStore, LeavesNothingWhenTheSettingsCannotBeWritten) {
  const TempDir dir;
  EXPECT_FALSE(ScanStore::create(dir / "duck", settingsFor(0), someCalibration()));
  EXPECT_FALSE(ScanStore::create(dir / "duck", settingsFor(2), Calibration{}));
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

TEST(ScanStore, IsOpenInOneProgramAtATime) {
  const TempDir dir;
  const auto first = ScanStore::create(dir / "duck", settingsFor(2), someCalibration());
  ASSERT_TRUE(first) << first.error().sentence();
  const auto second = ScanStore::open(dir / "duck");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Error::Code::kBusy);
}

TEST(ScanStore, DropsWhatAKillLeavesBehind) {
  const TempDir dir;
  makeScan(dir / "duck", 9, {0, 1, 2, 3});
  const auto frames = dir / "duck" / "frames";
  putFile(frames / ".77-0.gyre-part", "half a picture");
  putFile(frames / "view_0004.png", fileText(frames / "view_0003.png"));  // no line
  std::filesystem::remove(frames / "view_0002.png");                      // a line, no picture
  const std::string whole = fileText(frames / "view_0003.png");
  putFile(frames / "view_0003.png", whole.substr(0, whole.size() - 4));
  auto store = ScanStore::open(dir / "duck");
  ASSERT_TRUE(store) << store.error().sentence();
  EXPECT_THAT(numbersOf(*store), ElementsAre(0, 1));
  EXPECT_FALSE(std::filesystem::exists(frames / ".77-0.gyre-part"));
  for (const int view : {2, 3, 4}) ASSERT_TRUE(store->addView(frameOf(view), 0));
  EXPECT_THAT(numbersOf(*store), ElementsAre(0, 1, 2, 3, 4));
}

TEST(ScanStore, OpensWithTheJournalCutAtEveryByte) {
  const TempDir dir;
  makeScan(dir / "duck", 3, {0, 1, 2});
  const auto journal = dir / "duck" / "journal.jsonl";
  const std::string whole = fileText(journal);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    putFile(journal, whole.substr(0, length));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(length), '\n');
    const auto store = ScanStore::open(dir / "duck");
    ASSERT_TRUE(store) << store.error().sentence();
    ASSERT_EQ(std::ssize(store->views()), lines);
  }
}

TEST(ScanStore, KilledAtAnyInstantHoldsEveryViewThatWasAdded) {
  for (int round = 0; round < 5; ++round) {
    const TempDir dir;
    int added[2];
    ASSERT_EQ(::pipe(added), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      auto store = ScanStore::create(dir / "duck", settingsFor(1000), someCalibration());
      for (int view = 0; store && view < 1000; ++view) {
        if (!store->addView(frameOf(view), view)) break;
        if (::write(added[1], &view, sizeof view) != sizeof view) break;
      }
      ::_exit(0);
    }
    ::close(added[1]);
    int promised = 0;
    int view = -1;
    while (promised < 2 * round && ::read(added[0], &view, sizeof view) == sizeof view) ++promised;
    ::usleep(static_cast<unsigned>(137 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(added[0], &view, sizeof view) == sizeof view) ++promised;
    ::close(added[0]);
    if (!std::filesystem::exists(dir / "duck")) {
      EXPECT_EQ(promised, 0);
      continue;
    }
    const auto store = ScanStore::open(dir / "duck");
    ASSERT_TRUE(store) << store.error().sentence();
    EXPECT_GE(std::ssize(store->views()), promised);
    EXPECT_LE(std::ssize(store->views()), promised + 1);
    for (const CapturedView& captured : store->views()) EXPECT_TRUE(showsView(*store, captured));
  }
}

TEST(ScanStore, TellsWhatIsNoScan) {
  const TempDir dir;
  EXPECT_EQ(ScanStore::open(dir / "nowhere").error().code, Error::Code::kNotFound);
  EXPECT_THAT(ScanStore::open(dir.path()).error().what, HasSubstr("There is no scan"));
  EXPECT_FALSE(ScanStore::open(putFile(dir / "x.gyre", "{}")));
  putFile(dir / "y.gyre", "{}");
  EXPECT_THAT(ScanStore::open(dir.path()).error().what, HasSubstr("several"));
}

}  // namespace
}  // namespace gyre
