// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/turntable_word.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(TurntableWord, BarePortsAreFoundOut) {
  const auto serial = turntableWord("/dev/ttyUSB0");
  ASSERT_TRUE(serial);
  EXPECT_EQ(serial->port, "/dev/ttyUSB0");
  EXPECT_TRUE(serial->firmware.empty());
  EXPECT_FALSE(serial->isNetwork());
  const auto network = turntableWord("tcp:192.168.4.1:23");
  ASSERT_TRUE(network);
  EXPECT_EQ(network->port, "tcp:192.168.4.1:23");
  EXPECT_TRUE(network->isNetwork());
}

TEST(TurntableWord, FirmwareStandsBeforeThePort) {
  const auto serial = turntableWord("fabscan:/dev/ttyUSB0");
  ASSERT_TRUE(serial);
  EXPECT_EQ(serial->firmware, "fabscan");
  EXPECT_EQ(serial->port, "/dev/ttyUSB0");
  const auto network = turntableWord("marlin:tcp:[::1]:23");
  ASSERT_TRUE(network);
  EXPECT_EQ(network->firmware, "marlin");
  EXPECT_EQ(network->port, "tcp:[::1]:23");
}

TEST(TurntableWord, DescriptionStandsBeforeThePort) {
  const auto word = turntableWord("tables/mine.json:/dev/serial/by-id/usb-1a86:x");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->description, "tables/mine.json");
  EXPECT_EQ(word->port, "/dev/serial/by-id/usb-1a86:x");
}

TEST(TurntableWord, HandMayTellItsMarks) {
  EXPECT_EQ(turntableWord("hand")->marks, 0);
  EXPECT_TRUE(turntableWord("hand")->port.empty());
  EXPECT_EQ(turntableWord("hand:36")->marks, 36);
  EXPECT_EQ(turntableWord("hand:free")->marks, 0);
  EXPECT_TRUE(turntableWord("hand:free")->port.empty());
  for (const char* wrong : {"hand:", "hand:1", "hand:x", "hand:36x", "hand:-5", "hand:9999999"}) {
    const auto word = turntableWord(wrong);
    ASSERT_FALSE(word) << wrong;
    EXPECT_EQ(word.error().code, Error::Code::kInvalidInput);
  }
}

TEST(TurntableWord, WordWithoutAPortIsRefused) {
  for (const char* wrong : {"", "marlin:", "mine.json:"}) {
    EXPECT_FALSE(turntableWord(wrong)) << wrong;
  }
}

TEST(TurntableWord, LastingWordKeepsFirmwareAndWholePaths) {
  EXPECT_EQ(lastingTurntableWord("marlin:tcp:host:23"), "marlin:tcp:host:23");
  EXPECT_EQ(lastingTurntableWord("hand:36"), "hand:36");
  EXPECT_EQ(lastingTurntableWord("/dev/no-such-port"), "/dev/no-such-port");
  const std::string lasting = lastingTurntableWord("mine.json:/dev/no-such-port");
  EXPECT_TRUE(lasting.starts_with("/")) << lasting;
  EXPECT_TRUE(lasting.ends_with("/mine.json:/dev/no-such-port")) << lasting;
}

}  // namespace
}  // namespace gyre
