// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/firmware_server.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/device/tcp_port.h"

namespace gyre {
namespace {

using Code = Error::Code;

class FirmwareServerTest : public testing::Test {
 protected:
  FirmwareServerTest() {
    auto server = FirmwareServer::start(firmware_, 0);
    EXPECT_TRUE(server) << server.error().sentence();
    server_ = *std::move(server);
  }
  std::string address() const { return "tcp:127.0.0.1:" + std::to_string(server_->port()); }
  std::unique_ptr<ProtocolTurntable> connect() const {
    auto port = TcpPort::open(address(), 1.0);
    EXPECT_TRUE(port) << port.error().sentence();
    auto table = ProtocolTurntable::open(*std::move(port), {}, Task());
    EXPECT_TRUE(table) << table.error().sentence();
    return *std::move(table);
  }

  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  std::shared_ptr<TurntableFirmware> firmware_ =
      std::make_shared<TurntableFirmware>(TurntableFirmwareOptions{}, shaft_, SimClock(20.0));
  std::unique_ptr<FirmwareServer> server_;
};

TEST_F(FirmwareServerTest, TurnsATableEndToEnd) {
  const auto table = connect();
  EXPECT_EQ(table->info().device_id, address());
  ASSERT_TRUE(table->moveTo(radFromDeg(45.0), Task()));
  EXPECT_EQ(shaft_->steps(), 400);
}

TEST_F(FirmwareServerTest, ServesOneHostAfterTheOther) {
  for (int i = 1; i <= 3; ++i) {
    const auto table = connect();
    ASSERT_TRUE(table->moveTo(radFromDeg(9.0), Task()));
    EXPECT_EQ(shaft_->steps(), i * 80);
  }
}

TEST_F(FirmwareServerTest, TurnsASecondHostAway) {
  const auto table = connect();
  const auto second = TcpPort::open(address(), 1.0);
  ASSERT_TRUE(second) << second.error().sentence();
  std::byte byte{};
  const Result<std::size_t> count = (*second)->read({&byte, 1}, 2.0);
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().code, Code::kGone);
  EXPECT_TRUE(table->moveTo(radFromDeg(9.0), Task()));
}

TEST_F(FirmwareServerTest, EndOfTheServerIsAPortThatIsGone) {
  const auto table = connect();
  server_.reset();
  firmware_->pullCable();
  const Result<void> moved = table->moveTo(radFromDeg(9.0), Task());
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, Code::kGone);
}

TEST_F(FirmwareServerTest, TakenAndWrongPortsAreNamed) {
  const auto taken = FirmwareServer::start(firmware_, server_->port());
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, Code::kBusy);
  EXPECT_EQ(FirmwareServer::start(firmware_, 70000).error().code, Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
