// A socket on which a server of a test listens.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>

#include <cstdint>
#include <utility>

#include "core/base/check.h"

namespace gyre::test {

// Listens on a free port of this machine only; gives the socket, which the caller closes, and the
// port.
inline std::pair<int, std::uint16_t> listenOnLoopback() {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  GYRE_CHECK(bind(listener, generic, size) == 0 && listen(listener, 4) == 0);
  GYRE_CHECK(getsockname(listener, generic, &size) == 0);
  return {listener, ntohs(address.sin_port)};
}

}  // namespace gyre::test
