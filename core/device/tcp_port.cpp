// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/tcp_port.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "core/base/clock.h"

namespace gyre {
namespace {

std::string systemText(int error_number) { return std::system_category().message(error_number); }

struct Address {
  std::string host;
  std::string service;
};

std::optional<Address> addressIn(std::string_view text) {
  if (text.starts_with("tcp:")) text.remove_prefix(4);
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  const std::string_view service = text.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  int number = 0;
  const auto [end, failed] =
      std::from_chars(service.data(), service.data() + service.size(), number);
  const bool whole = failed == std::errc() && end == service.data() + service.size();
  if (host.empty() || !whole || number < 1 || number > 65535) return std::nullopt;
  return Address{std::string(host), std::string(service)};
}

// Waits for the events until the deadline. Returns 0, ETIMEDOUT, or what poll() failed with.
int waitFor(int socket, short events, double deadline_s) {
  for (;;) {
    const double left_s = std::max(0.0, deadline_s - steadySeconds());
    pollfd entry{socket, events, 0};
    const int ready = poll(&entry, 1, static_cast<int>(std::ceil(std::min(left_s, 1e6) * 1000.0)));
    if (ready > 0) return 0;
    if (ready == 0) return ETIMEDOUT;
    if (errno != EINTR) return errno;
  }
}

// Connects a new socket within the deadline. Returns 0 or why it failed.
int connectBy(double deadline_s, const addrinfo& where, int& socket_made) {
  const int made =
      socket(where.ai_family, where.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, where.ai_protocol);
  if (made < 0) return errno;
  int error_number = connect(made, where.ai_addr, where.ai_addrlen) == 0 ? 0 : errno;
  if (error_number == EINPROGRESS) {
    error_number = waitFor(made, POLLOUT, deadline_s);
    socklen_t size = sizeof(error_number);
    if (error_number == 0) getsockopt(made, SOL_SOCKET, SO_ERROR, &error_number, &size);
  }
  if (error_number != 0) {
    close(made);
    return error_number;
  }
  socket_made = made;
  return 0;
}

Error connectionError(int error_number, const std::string& name) {
  if (error_number == ECONNREFUSED) {
    return {Error::Code::kRejected, "Nothing listens at " + name + ".",
            "Check the address and the port number, and that the board is on."};
  }
  if (error_number == ETIMEDOUT) {
    return {Error::Code::kTimeout, "No answer from " + name + ".",
            "Check the address, and that the board is on the same network."};
  }
  return {Error::Code::kIo,
          "The connection to " + name + " failed (" + systemText(error_number) + ").",
          "Check the network."};
}

}  // namespace

Result<std::unique_ptr<TcpPort>> TcpPort::open(const std::string& address, double timeout_s) {
  const std::optional<Address> where = addressIn(address);
  if (!where) {
    return Error{Error::Code::kInvalidInput, "\"" + address + "\" is no network address.",
                 "Write it as HOST:PORT, such as tcp:192.168.4.1:23."};
  }
  const std::string name = "tcp:" + address.substr(address.starts_with("tcp:") ? 4 : 0);
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(where->host.c_str(), where->service.c_str(), &hints, &found) != 0) {
    return Error{Error::Code::kNotFound, "No host is called \"" + where->host + "\".",
                 "Check its name, or use its number."};
  }
  const double deadline_s = steadySeconds() + timeout_s;
  int connected = -1;
  int error_number = ECONNREFUSED;
  for (const addrinfo* entry = found; entry != nullptr && connected < 0; entry = entry->ai_next) {
    error_number = connectBy(deadline_s, *entry, connected);
  }
  freeaddrinfo(found);
  if (connected < 0) return connectionError(error_number, name);
  return adopt(connected, name);
}

std::unique_ptr<TcpPort> TcpPort::adopt(int socket, std::string name) {
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  const int on = 1;  // a single '?' or '!' must not wait for company
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  return std::unique_ptr<TcpPort>(new TcpPort(socket, std::move(name)));
}

TcpPort::~TcpPort() { close(socket_); }

Error TcpPort::failure(int error_number) const {
  const bool gone = error_number == ECONNRESET || error_number == EPIPE ||
                    error_number == ENOTCONN || error_number == ETIMEDOUT ||
                    error_number == EHOSTUNREACH || error_number == ENETDOWN;
  if (gone) {
    return {Error::Code::kGone, "The connection to " + name_ + " has ended.",
            "Check the network and the board's power, then connect again."};
  }
  return {Error::Code::kIo, "Talking to " + name_ + " failed (" + systemText(error_number) + ").",
          ""};
}

Result<std::size_t> TcpPort::read(std::span<std::byte> buffer, double timeout_s) {
  const double deadline_s = steadySeconds() + timeout_s;
  for (;;) {
    const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
    if (count > 0) return static_cast<std::size_t>(count);
    if (count == 0 && !buffer.empty()) return failure(ECONNRESET);
    if (errno != EAGAIN && errno != EINTR) return failure(errno);
    const int waited = waitFor(socket_, POLLIN, deadline_s);
    if (waited == ETIMEDOUT) return std::size_t{0};
    if (waited != 0) return failure(waited);
  }
}

Result<void> TcpPort::write(std::span<const std::byte> bytes, double timeout_s) {
  const double deadline_s = steadySeconds() + timeout_s;
  while (!bytes.empty()) {
    const ssize_t count = send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) return failure(errno);
    const int waited = waitFor(socket_, POLLOUT, deadline_s);
    if (waited == ETIMEDOUT) {
      return Error{Error::Code::kTimeout, name_ + " takes no more data.",
                   "Check the network and the board's power, then connect again."};
    }
    if (waited != 0) return failure(waited);
  }
  return {};
}

}  // namespace gyre
