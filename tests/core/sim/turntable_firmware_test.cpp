// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/turntable_firmware.h"

#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

using testing::HasSubstr;

class TurntableFirmwareTest : public testing::Test {
 protected:
  static void say(BytePort& port, std::string_view text) {
    ASSERT_TRUE(port.write(std::as_bytes(std::span(text)), 1.0));
  }
  // What is said until the text comes, or all of it after two seconds.
  static std::string hearUntil(BytePort& port, std::string_view text) {
    std::string heard;
    const double end_s = steadySeconds() + 2.0;
    while (heard.find(text) == std::string::npos && steadySeconds() < end_s) {
      std::array<std::byte, 64> buffer{};
      const Result<std::size_t> count = port.read(buffer, 0.1);
      if (!count) return heard + "<gone>";
      for (const std::byte byte : std::span(buffer).first(*count)) heard += static_cast<char>(byte);
    }
    return heard;
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  TurntableFirmware firmware_{TurntableFirmwareOptions{}, shaft_, SimClock(20.0)};
};

TEST_F(TurntableFirmwareTest, GreetsWhenItsPortIsOpened) {
  const auto port = firmware_.openPort();
  EXPECT_EQ(hearUntil(*port, "help]\r\n"), "\r\nGrbl 1.1h ['$' for help]\r\n");
  EXPECT_TRUE(firmware_.attached());
}

TEST_F(TurntableFirmwareTest, TurnsTheShaftInItsTime) {
  const auto port = firmware_.openPort();
  hearUntil(*port, "help]");
  const double begin_s = steadySeconds();
  say(*port, "G1X90F1200\nG4P0.01\n");
  EXPECT_THAT(hearUntil(*port, "ok\r\nok\r\n"), HasSubstr("ok\r\nok\r\n"));
  EXPECT_EQ(shaft_->steps(), 800);
  EXPECT_GE(steadySeconds() - begin_s, 4.6 / 20.0);  // never faster than its motor
}

TEST_F(TurntableFirmwareTest, OpeningAgainEndsTheOldPortAndKeepsTheShaft) {
  const auto first = firmware_.openPort();
  hearUntil(*first, "help]");
  say(*first, "G0X90\nG4P0.01\n");
  hearUntil(*first, "ok\r\nok\r\n");
  const auto second = firmware_.openPort();
  EXPECT_THAT(hearUntil(*second, "help]"), HasSubstr("Grbl"));
  EXPECT_THAT(hearUntil(*first, "nothing"), HasSubstr("<gone>"));
  EXPECT_EQ(shaft_->steps(), 800);
}

TEST_F(TurntableFirmwareTest, PulledCableIsGoneAndCanBePluggedInAgain) {
  auto port = firmware_.openPort();
  hearUntil(*port, "help]");
  firmware_.pullCable();
  EXPECT_THAT(hearUntil(*port, "nothing"), HasSubstr("<gone>"));
  EXPECT_FALSE(firmware_.attached());
  port = firmware_.openPort();
  EXPECT_THAT(hearUntil(*port, "help]"), HasSubstr("Grbl"));
}

TEST_F(TurntableFirmwareTest, NoticesThatTheHostHasClosedThePort) {
  firmware_.openPort().reset();
  const double end_s = steadySeconds() + 2.0;
  while (firmware_.attached() && steadySeconds() < end_s) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(firmware_.attached());
}

TEST_F(TurntableFirmwareTest, ResetButtonGreetsAgain) {
  const auto port = firmware_.openPort();
  hearUntil(*port, "help]");
  firmware_.pressReset();
  EXPECT_THAT(hearUntil(*port, "help]"), HasSubstr("Grbl"));
}

}  // namespace
}  // namespace gyre
