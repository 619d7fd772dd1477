// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/firmware_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>

#include "core/device/tcp_port.h"

namespace gyre {
namespace {

constexpr int kPoll_ms = 20;   // how long the end of the server may take
constexpr int kPatience = 10;  // polls

// A listening socket on 127.0.0.1, or -1 with errno set.
int listenOn(int port, sockaddr_in& address) {
  const int made = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (made < 0) return -1;
  const int on = 1;
  setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(made, generic, size) == 0 && listen(made, 4) == 0 &&
      getsockname(made, generic, &size) == 0) {
    return made;
  }
  const int error_number = errno;
  close(made);
  errno = error_number;
  return -1;
}

}  // namespace

Result<std::unique_ptr<FirmwareServer>> FirmwareServer::start(
    std::shared_ptr<TurntableFirmware> firmware, int port) {
  if (port < 0 || port > 65535) {
    return Error{Error::Code::kInvalidInput, std::to_string(port) + " is no TCP port.",
                 "Use 1024 to 65535, or 0 for a free one."};
  }
  sockaddr_in address{};
  const int listening = listenOn(port, address);
  if (listening < 0) {
    const int error_number = errno;
    return Error{error_number == EADDRINUSE ? Error::Code::kBusy
                 : error_number == EACCES   ? Error::Code::kNoPermission
                                            : Error::Code::kIo,
                 "TCP port " + std::to_string(port) + " cannot be served (" +
                     std::system_category().message(error_number) + ").",
                 "Use another port, or 0 for a free one."};
  }
  return std::unique_ptr<FirmwareServer>(
      new FirmwareServer(std::move(firmware), listening, ntohs(address.sin_port)));
}

FirmwareServer::FirmwareServer(std::shared_ptr<TurntableFirmware> firmware, int socket, int port)
    : firmware_(std::move(firmware)),
      socket_(socket),
      port_(port),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

FirmwareServer::~FirmwareServer() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
}

void FirmwareServer::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd entry{socket_, POLLIN, 0};
    if (poll(&entry, 1, kPoll_ms) <= 0) continue;
    const int host = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (host < 0) continue;
    auto wire = TcpPort::adopt(host, "tcp:127.0.0.1:" + std::to_string(port_));
    // A host that has just hung up is noticed a moment later.
    for (int i = 0; i < kPatience && firmware_->attached(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kPoll_ms));
    }
    if (!firmware_->attached()) firmware_->attach(std::move(wire));
  }
}

}  // namespace gyre
