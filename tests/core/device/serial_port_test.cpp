// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/serial_port.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/needs_pty.h"
#include "tests/support/pty_port.h"

namespace gyre {
namespace {

const auto* const kNeedsPty = testing::AddGlobalTestEnvironment(new test::NeedsPty);

using testing::HasSubstr;
using testing::IsEmpty;
using Code = Error::Code;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

TEST(SerialPort, CarriesBytesBothWays) {
  const auto device = PtyPort::make();
  auto port = SerialPort::open(device->path());
  ASSERT_TRUE(port) << port.error().sentence();
  EXPECT_EQ((*port)->name(), device->path());
  std::array<std::byte, 16> buffer{};
  ASSERT_TRUE((*port)->write(bytesOf("?\x18"), 1.0));
  const Result<std::size_t> heard = device->read(buffer, 1.0);
  ASSERT_TRUE(heard);
  EXPECT_EQ(*heard, 2U);
  EXPECT_EQ(buffer[1], std::byte{0x18});  // raw: the terminal eats no control character
  ASSERT_TRUE(device->write(bytesOf("ok\r\n"), 1.0));
  const Result<std::size_t> answered = (*port)->read(buffer, 1.0);
  ASSERT_TRUE(answered);
  EXPECT_EQ(*answered, 4U);
}

TEST(SerialPort, ReadGivesNothingAfterItsTime) {
  const auto device = PtyPort::make();
  auto port = SerialPort::open(device->path());
  ASSERT_TRUE(port) << port.error().sentence();
  std::array<std::byte, 16> buffer{};
  const double begin_s = steadySeconds();
  const Result<std::size_t> count = (*port)->read(buffer, 0.05);
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 0U);
  EXPECT_GE(steadySeconds() - begin_s, 0.045);
  EXPECT_LT(steadySeconds() - begin_s, 1.0);
}

TEST(SerialPort, PulledCableIsGone) {
  auto device = PtyPort::make();
  auto port = SerialPort::open(device->path());
  ASSERT_TRUE(port) << port.error().sentence();
  device.reset();
  std::array<std::byte, 16> buffer{};
  const Result<std::size_t> count = (*port)->read(buffer, 0.2);
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().code, Code::kGone);
  const Result<void> written = (*port)->write(bytesOf("?"), 0.2);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Code::kGone);
}

TEST(SerialPort, IsHeldExclusively) {
  const auto device = PtyPort::make();
  {
    auto port = SerialPort::open(device->path());
    ASSERT_TRUE(port) << port.error().sentence();
    const auto second = SerialPort::open(device->path());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, Code::kBusy);
  }
  EXPECT_TRUE(SerialPort::open(device->path()));
}

TEST(SerialPort, OpensByAStableName) {
  const auto device = PtyPort::make();
  const auto link =
      std::filesystem::temp_directory_path() / ("gyre-port-" + std::to_string(getpid()));
  std::filesystem::create_symlink(device->path(), link);
  const auto port = SerialPort::open(link);
  std::filesystem::remove(link);
  ASSERT_TRUE(port) << port.error().sentence();
  EXPECT_EQ((*port)->name(), link.string());
}

TEST(SerialPort, MissingDeviceAndWrongFileAreNamed) {
  EXPECT_EQ(SerialPort::open("/dev/ttyACM77").error().code, Code::kNotFound);
  EXPECT_EQ(SerialPort::open("/dev/null").error().code, Code::kInvalidInput);
}

// In a child, because root may open everything and has to become nobody first.
TEST(SerialPortDeathTest, MissingPermissionNamesTheCommand) {
  const auto file =
      std::filesystem::temp_directory_path() / ("gyre-locked-" + std::to_string(getpid()));
  std::ofstream(file).close();
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_EXIT(
      {
        if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) std::exit(2);
        const auto port = SerialPort::open(file);
        std::cerr << port.error().sentence();
        std::exit(port.error().code == Code::kNoPermission ? 0 : 1);
      },
      testing::ExitedWithCode(0), "sudo usermod -aG dialout");
  std::filesystem::remove(file);
}

TEST(SerialPort, HindranceIsEmptyForWhatMayBeOpened) {
  EXPECT_THAT(portHindrance("/dev/null"), IsEmpty());
  EXPECT_THAT(portHindrance("/dev/ttyACM77"), HasSubstr("There is no device"));
}

TEST(SerialPort, TurnsATableEndToEnd) {
  const auto shaft = std::make_shared<Shaft>();
  TurntableFirmware firmware({}, shaft, SimClock(20.0));
  auto device = PtyPort::make();
  const std::string path = device->path();
  device->onOpened([&] { firmware.pressReset(); });
  firmware.attach(std::move(device));
  auto port = SerialPort::open(path);
  ASSERT_TRUE(port) << port.error().sentence();
  auto table = ProtocolTurntable::open(*std::move(port), {}, Task());
  ASSERT_TRUE(table) << table.error().sentence();
  ASSERT_TRUE((*table)->moveTo(radFromDeg(45.0), Task()));
  EXPECT_EQ(shaft->steps(), 400);
  firmware.pullCable();
  const Result<void> moved = (*table)->moveTo(radFromDeg(90.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kGone);
}

}  // namespace
}  // namespace gyre
