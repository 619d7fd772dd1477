// A whole `gyre scan` over a serial port and a network camera, as on real devices: the port is a
// pseudo terminal with the simulated firmware behind it, the camera an HTTP server on loopback.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/device/serial_port.h"
#include "core/device/whole_jpeg.h"
#include "core/io/calibration_file.h"
#include "core/io/picture_file.h"
#include "core/io/scan_store.h"
#include "core/sim/renderer.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/command_answer.h"
#include "tests/support/mjpeg_server.h"
#include "tests/support/needs_pty.h"
#include "tests/support/pty_port.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

const auto* const kNeedsPty = testing::AddGlobalTestEnvironment(new test::NeedsPty);

using test::Answer;
using test::gyre;

constexpr int kViews = 12;

// A turntable and a camera that the program can only reach as it reaches real ones.
class Room {
 public:
  explicit Room(const TurntableFirmwareOptions& board = {})
      : shaft_(std::make_shared<Shaft>()),
        firmware_(board, shaft_, SimClock(20.0)),
        renderer_(atImageWidth(RigSettings{}, 320)),
        camera_(
            [this](int) { return renderer_.render(shaft_->steps(), TableLoad::kObject).image_bgr; },
            15.0) {
    auto device = PtyPort::make();
    port_ = device->path();
    device->onOpened([this] { firmware_.pressReset(); });
    firmware_.attach(std::move(device));
  }

  const std::string& port() const { return port_; }
  std::string cameraUrl() const { return camera_.url(); }
  const Renderer& renderer() const { return renderer_; }
  TurntableFirmware& firmware() { return firmware_; }
  const Shaft& shaft() const { return *shaft_; }

 private:
  std::shared_ptr<Shaft> shaft_;
  TurntableFirmware firmware_;
  Renderer renderer_;
  std::string port_;
  test::MjpegServer camera_;
};

std::vector<std::string> scanWords(const Room& room, const TempDir& temp) {
  const auto calibration = temp / "calibration.json";
  const auto empty = temp / "empty.png";
  EXPECT_TRUE(writeCalibration(calibration, trueCalibration(room.renderer().rig())));
  EXPECT_TRUE(writePicture(empty, room.renderer().render(0, TableLoad::kEmpty).image_bgr));
  return {"scan",       "--turntable",          room.port(),
          "--camera",   room.cameraUrl(),       "--calibration",
          calibration,  "--background",         empty,
          "--views",    std::to_string(kViews), "--out",
          temp / "scan"};
}

TEST(RealPortScan, CapturesEveryViewAtRest) {
  Room room;
  const TempDir temp;
  const Answer answer = gyre(scanWords(room, temp));
  const auto store = ScanStore::open(temp / "scan");
  ASSERT_TRUE(store) << answer.err;
  ASSERT_TRUE(store->complete()) << answer.err;
  EXPECT_TRUE(std::filesystem::exists(temp / "scan" / "points.ply")) << answer.err;
  EXPECT_THAT(answer.err, testing::HasSubstr("focus is not locked"));
  for (const CapturedView& view : store->views()) {
    // What the camera sends of the table where it truly stands, to the bit.
    const Frame truth = room.renderer().render(view.steps, TableLoad::kObject);
    const cv::Mat sent = decodeWholeJpeg(test::jpegOf(truth.image_bgr)).value();
    EXPECT_EQ(cv::norm(store->readView(view).value()->image_bgr, sent, cv::NORM_INF), 0.0)
        << "view " << view.view;
  }
}

TEST(RealPortScan, EndsWithASentenceWhenThePortVanishes) {
  Room room;
  const TempDir temp;
  std::jthread puller([&] {
    const auto journal = temp / "scan" / "journal.jsonl";
    for (int i = 0; i < 3000; ++i) {
      const std::string lines = fileText(journal);
      if (std::count(lines.begin(), lines.end(), '\n') >= 2) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    room.firmware().pullCable();
  });
  const Answer answer = gyre(scanWords(room, temp));
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.err, testing::HasSubstr("views are kept; `gyre resume"));
  const auto store = ScanStore::open(temp / "scan");
  ASSERT_TRUE(store);
  EXPECT_GE(store->views().size(), 2U);
  EXPECT_FALSE(store->complete());
}

TEST(RealPortScan, PausesWithASentenceWhenTheBoardRaisesAnAlarm) {
  Room room;
  {
    const auto terminal = SerialPort::open(room.port(), 115200);
    ASSERT_TRUE(terminal) << terminal.error().sentence();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const std::string limits_on = "$21=1\n";
    ASSERT_TRUE((*terminal)->write(std::as_bytes(std::span(limits_on)), 1.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  const TempDir temp;
  std::int64_t stood = 0;
  std::jthread presser([&] {
    const auto journal = temp / "scan" / "journal.jsonl";
    for (int i = 0; i < 3000; ++i) {
      const std::string lines = fileText(journal);
      if (std::count(lines.begin(), lines.end(), '\n') >= 2) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    room.firmware().pressLimitSwitch();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    stood = room.shaft().steps();
  });
  const Answer answer = gyre(scanWords(room, temp));
  presser.join();
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.err, testing::HasSubstr("stopped by itself"));
  EXPECT_THAT(answer.err, testing::HasSubstr("views are kept; `gyre resume"));
  EXPECT_EQ(room.shaft().steps(), stood);
  const std::string log = fileText(temp / "scan" / "wire.log");
  EXPECT_FALSE(log.find("> $X", log.rfind("= opened")) != std::string::npos);
}

TEST(RealPortScan, LockedBoardIsNotMovedUnlessTheWordIsGiven) {
  TurntableFirmwareOptions board;
  board.homing = true;
  Room room(board);
  const TempDir temp;
  std::vector<std::string> words = scanWords(room, temp);
  const Answer refused = gyre(words);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, testing::HasSubstr("board is locked and moves nothing"));
  EXPECT_THAT(refused.err, testing::HasSubstr("--unlock"));
  EXPECT_EQ(room.shaft().steps(), 0);
  EXPECT_FALSE(std::filesystem::exists(temp / "scan"));
  words.emplace_back("--unlock");
  const Answer allowed = gyre(words);
  const auto store = ScanStore::open(temp / "scan");
  ASSERT_TRUE(store) << allowed.err;
  EXPECT_TRUE(store->complete()) << allowed.err;
}

TEST(RealPortScan, KeepsTheWiresLogWithTheScan) {
  Room room;
  const TempDir temp;
  (void)gyre(scanWords(room, temp));
  const std::string log = fileText(temp / "scan" / "wire.log");
  EXPECT_THAT(log, testing::HasSubstr("> $$\\n"));
  EXPECT_THAT(log, testing::HasSubstr("G53G1X"));
  EXPECT_THAT(log, testing::HasSubstr("< ok"));
}

TEST(RealPort, MotorThatStandsIsToldByACamera) {
  Room room;
  const std::vector<std::string> probe = {"devices", "--probe", room.port(), "--json"};
  std::vector<std::string> words = probe;
  words.insert(words.end(), {"--watch", room.cameraUrl()});
  const Answer turns = gyre(words);
  EXPECT_EQ(turns.code, 0) << turns.err;
  EXPECT_THAT(turns.out, testing::HasSubstr("\"state\": \"turntable\""));
  EXPECT_EQ(room.shaft().steps(), 0);

  // The picture stays what it is, whatever the board says that it does.
  const cv::Mat still = room.renderer().render(0, TableLoad::kObject).image_bgr;
  const test::MjpegServer blind([&](int) { return still; }, 15.0);
  words = probe;
  words.insert(words.end(), {"--watch", blind.url()});
  const Answer stands = gyre(words);
  EXPECT_EQ(stands.code, 1);
  EXPECT_THAT(stands.out, testing::HasSubstr("\"state\": \"motor-stands\""));
  EXPECT_THAT(stands.out, testing::HasSubstr("sees nothing move"));
  EXPECT_THAT(stands.out, testing::HasSubstr("Grbl 1.1h"));
}

}  // namespace
}  // namespace gyre
