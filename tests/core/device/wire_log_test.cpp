// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/wire_log.h"

#include <array>
#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sim/pipe_port.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

TEST(WireLog, KeepsWhatPassesBothWaysAsItPasses) {
  const TempDir folder;
  auto log = WireLog::open(folder / "deep/wire.log");
  ASSERT_TRUE(log) << log.error().sentence();
  auto [host, device] = PipePort::makePair("the pipe");
  LoggedPort port(std::move(host), *log);
  ASSERT_TRUE(port.write(bytesOf("G1X20\n\x18"), 1.0));
  ASSERT_TRUE(device->write(bytesOf("ok\r\n\xff\\"), 1.0));
  std::array<std::byte, 64> buffer{};
  const auto count = port.read(buffer, 1.0);
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 6U);
  EXPECT_EQ(port.name(), "the pipe");
  device.reset();
  EXPECT_FALSE(port.read(buffer, 1.0));
  EXPECT_FALSE(port.read(buffer, 1.0));  // told once
  const std::string text = fileText(folder / "deep/wire.log");
  EXPECT_THAT(text, HasSubstr("= opened the pipe\n"));
  EXPECT_THAT(text, HasSubstr("Z > G1X20\\n\\x18\n"));
  EXPECT_THAT(text, HasSubstr("Z < ok\\r\\n\\xff\\\\\n"));
  EXPECT_THAT(text, HasSubstr("has ended"));
  EXPECT_EQ(text.find("has ended"), text.rfind("has ended"));
  EXPECT_THAT(text.substr(0, text.find('\n')),
              MatchesRegex("[0-9]+-[0-9]+-[0-9]+T[0-9]+:[0-9]+:[0-9]+\\.[0-9]+Z = opened.*"));
}

TEST(WireLog, StaysWithinTwiceItsLimitAndKeepsTheLatest) {
  const TempDir folder;
  auto log = WireLog::open(folder / "wire.log", 1000);
  ASSERT_TRUE(log);
  for (int i = 0; i < 200; ++i) (*log)->note('>', "line " + std::to_string(i));
  const std::string now = fileText(folder / "wire.log");
  const std::string before = fileText(folder / "wire.log.1");
  EXPECT_LE(now.size(), 1000U);
  EXPECT_LE(before.size(), 1000U);
  EXPECT_THAT(now, HasSubstr("line 199\n"));
  EXPECT_THAT(before + now, HasSubstr("line 185\n"));
}

TEST(WireLog, GoesOnWhereItWas) {
  const TempDir folder;
  (*WireLog::open(folder / "wire.log"))->note('>', "first");
  (*WireLog::open(folder / "wire.log"))->note('>', "second");
  EXPECT_THAT(fileText(folder / "wire.log"), HasSubstr("first\n"));
  EXPECT_THAT(fileText(folder / "wire.log"), HasSubstr("second\n"));
}

TEST(WireLog, PlaceThatCannotBeWrittenIsTold) {
  const TempDir folder;
  putFile(folder / "file", "x");
  const auto log = WireLog::open(folder / "file/wire.log");
  ASSERT_FALSE(log);
  EXPECT_EQ(log.error().code, Error::Code::kIo);
}

}  // namespace
}  // namespace gyre
