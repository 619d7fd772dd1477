// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/tcp_port.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using Code = Error::Code;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

// Listens on a free port of this machine, and does nothing unless told.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(socket_, generic, size), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
    EXPECT_EQ(getsockname(socket_, generic, &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { close(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  std::unique_ptr<TcpPort> accept() {
    return TcpPort::adopt(::accept(socket_, nullptr, nullptr), "host");
  }
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

 private:
  int socket_;
  int port_ = 0;
};

TEST(TcpPort, CarriesBytesBothWays) {
  Listener listener;
  const auto port = TcpPort::open("tcp:" + listener.address(), 1.0);
  ASSERT_TRUE(port) << port.error().sentence();
  EXPECT_EQ((*port)->name(), "tcp:" + listener.address());
  const auto far_end = listener.accept();
  std::array<std::byte, 16> buffer{};
  ASSERT_TRUE((*port)->write(bytesOf("$I\n"), 1.0));
  EXPECT_EQ(*far_end->read(buffer, 1.0), 3U);
  ASSERT_TRUE(far_end->write(bytesOf("ok\r\n"), 1.0));
  EXPECT_EQ(*(*port)->read(buffer, 1.0), 4U);
}

TEST(TcpPort, RefusedPortIsToldAtOnce) {
  Listener listener;
  const std::string address = listener.address();
  listener.close();
  const double begin_s = steadySeconds();
  const auto port = TcpPort::open(address, 5.0);
  ASSERT_FALSE(port);
  EXPECT_EQ(port.error().code, Code::kRejected);
  EXPECT_THAT(port.error().what, HasSubstr(address));
  EXPECT_LT(steadySeconds() - begin_s, 1.0);
}

TEST(TcpPort, FrozenServerTimesOut) {
  Listener listener;  // accepts into its backlog and never answers
  const auto port = TcpPort::open(listener.address(), 1.0);
  ASSERT_TRUE(port) << port.error().sentence();
  std::array<std::byte, 16> buffer{};
  const double begin_s = steadySeconds();
  EXPECT_EQ(*(*port)->read(buffer, 0.05), 0U);
  EXPECT_GE(steadySeconds() - begin_s, 0.045);
  const std::vector<std::byte> much(std::size_t{32} << 20);
  const Result<void> written = (*port)->write(much, 0.1);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Code::kTimeout);
  EXPECT_LT(steadySeconds() - begin_s, 1.0);
}

TEST(TcpPort, HungUpServerIsGone) {
  Listener listener;
  const auto port = TcpPort::open(listener.address(), 1.0);
  ASSERT_TRUE(port) << port.error().sentence();
  listener.accept().reset();
  std::array<std::byte, 16> buffer{};
  const Result<std::size_t> count = (*port)->read(buffer, 1.0);
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().code, Code::kGone);
}

TEST(TcpPort, WrongAddressesAreNamed) {
  for (const char* address : {"", "tcp:", "localhost", "localhost:", ":23", "localhost:0",
                              "localhost:70000", "localhost:23x", "tcp:localhost:-1"}) {
    const auto port = TcpPort::open(address, 0.1);
    ASSERT_FALSE(port) << address;
    EXPECT_EQ(port.error().code, Code::kInvalidInput) << address;
    EXPECT_THAT(port.error().advice, HasSubstr("HOST:PORT"));
  }
}

}  // namespace
}  // namespace gyre
