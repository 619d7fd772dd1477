// Scans on a small disk of their own, which runs full or can only be read; and under odd names.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/io/scan_store.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kViews = 1000;

Calibration calibration() {
  Calibration calibration;
  calibration.camera.width_px = 16;
  calibration.camera.height_px = 12;
  calibration.camera.fx = calibration.camera.fy = 20.0;
  calibration.cam_from_table = Rigid3{};
  return calibration;
}

// Noise that no format makes smaller; larger than its calibration says, as the store need not know.
Frame frameOf(int view) {
  Frame frame;
  frame.view = view;
  frame.image_bgr = cv::Mat(300, 400, CV_8UC3);
  cv::setRNGSeed(view);
  cv::randu(frame.image_bgr, 0, 255);
  return frame;
}

ScanSettings settings() {
  ScanSettings settings;
  settings.views = kViews;
  return settings;
}

// A disk in memory that only this test sees.
class SmallDisk : public testing::Test {
 protected:
  void SetUp() override {
    const int own = ::geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS;
    if (::unshare(own) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("none", dir_.path().c_str(), "tmpfs", 0, "size=110m") != 0) {
      GTEST_SKIP() << "This system lets no test mount a disk of its own.";
    }
    mounted_ = true;
  }
  void TearDown() override {
    if (mounted_) ::umount2(dir_.path().c_str(), MNT_DETACH);
  }
  void fillUpTo(std::uintmax_t left) const {
    std::ofstream filler(dir_ / "filler", std::ios::binary);
    const std::string block(100'000, 'x');
    while (filler && fs::space(dir_.path()).available > left + block.size()) {
      filler.write(block.data(), static_cast<std::streamsize>(block.size()));
      filler.flush();
    }
  }

  TempDir dir_;
  bool mounted_ = false;
};

TEST_F(SmallDisk, IsRefusedBeforeTheScanWhereAllViewsWillNotFit) {
  fillUpTo(20'000'000);
  const auto store = ScanStore::create(dir_ / "scan", settings(), calibration());
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().code, Error::Code::kNoSpace);
  EXPECT_THAT(store.error().what, HasSubstr("MB free; this scan may take 100 MB"));
  EXPECT_FALSE(fs::exists(dir_ / "scan"));
}

TEST_F(SmallDisk, RunsFullWithoutLosingAView) {
  auto store = ScanStore::create(dir_ / "scan", settings(), calibration());
  ASSERT_TRUE(store) << store.error().sentence();
  fillUpTo(3'000'000);
  int added = 0;
  Result<void> kept;
  for (; added < kViews; ++added) {
    kept = store->addView(frameOf(added), added);
    if (!kept) break;
  }
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().code, Error::Code::kNoSpace);
  EXPECT_THAT(kept.error().what, HasSubstr("the disk is full"));
  EXPECT_GT(added, 2);
  // The same program goes on when there is room again.
  fs::remove(dir_ / "filler");
  EXPECT_TRUE(store->addView(frameOf(added), added));
  EXPECT_EQ(static_cast<int>(store->views().size()), added + 1);
}

TEST_F(SmallDisk, HoldsEveryViewWhenOpenedAfterItRanFull) {
  int added = 0;
  {
    auto store = ScanStore::create(dir_ / "scan", settings(), calibration());
    ASSERT_TRUE(store) << store.error().sentence();
    fillUpTo(2'000'000);
    while (added < kViews && store->addView(frameOf(added), added)) ++added;
  }
  auto opened = ScanStore::open(dir_ / "scan");
  ASSERT_TRUE(opened) << opened.error().sentence();
  EXPECT_EQ(static_cast<int>(opened->views().size()), added);
  for (const CapturedView& view : opened->views()) {
    const auto frame = opened->readView(view);
    ASSERT_TRUE(frame);
    EXPECT_EQ(cv::norm((*frame)->image_bgr, frameOf(view.view).image_bgr, cv::NORM_INF), 0.0);
  }
}

TEST_F(SmallDisk, ThatCanOnlyBeReadShowsItsScanAndTakesNoView) {
  {
    auto store = ScanStore::create(dir_ / "scan", settings(), calibration());
    ASSERT_TRUE(store && store->addView(frameOf(0), 0));
  }
  ASSERT_EQ(::mount("none", dir_.path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  auto store = ScanStore::open(dir_ / "scan");
  ASSERT_TRUE(store) << store.error().sentence();
  EXPECT_EQ(store->views().size(), 1U);
  EXPECT_TRUE(store->readView(store->views().front()));
  const auto kept = store->addView(frameOf(1), 1);
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().code, Error::Code::kNoPermission);
  EXPECT_THAT(kept.error().what, HasSubstr("can only be read"));
  const auto made = ScanStore::create(dir_ / "another", settings(), calibration());
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, Error::Code::kNoPermission);
}

TEST(ScanFolder, MayHaveAnyNameAndStandVeryDeep) {
  const TempDir dir;
  fs::path deep = dir.path();
  for (int i = 0; i < 12; ++i)
    deep /= "Kröte \xe2\x80\xae 蛙 \n 'quoted\" %s " + std::string(200, 'o');
  ASSERT_GT(deep.string().size(), 2500U);
  {
    auto store = ScanStore::create(deep / "äöü 猫.v1", settings(), calibration());
    ASSERT_TRUE(store) << store.error().sentence();
    ASSERT_TRUE(store->addView(frameOf(0), 0));
  }
  const auto opened = ScanStore::open(deep / "äöü 猫.v1");
  ASSERT_TRUE(opened) << opened.error().sentence();
  EXPECT_EQ(opened->views().size(), 1U);
}

TEST(ScanFolder, WhoseNameIsTooLongIsRefusedInWords) {
  const TempDir dir;
  const auto one = ScanStore::create(dir / std::string(300, 'x'), settings(), calibration());
  ASSERT_FALSE(one);
  EXPECT_THAT(one.error().what, HasSubstr("too long"));
  fs::path deep = dir.path();
  for (int i = 0; i < 30; ++i) deep /= std::string(200, 'y');
  const auto all = ScanStore::create(deep / "scan", settings(), calibration());
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().what, HasSubstr("too long"));
}

}  // namespace
}  // namespace gyre
