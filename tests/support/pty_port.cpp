// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/pty_port.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/base/check.h"

namespace gyre {

namespace {

// Negative when the machine has no pseudo terminals.
int openMaster() {
  const int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (master < 0 || (grantpt(master) == 0 && unlockpt(master) == 0)) return master;
  close(master);
  return -1;
}

}  // namespace

bool PtyPort::available() {
  const int master = openMaster();
  std::array<char, 64> name{};
  const bool usable = master >= 0 && ptsname_r(master, name.data(), name.size()) == 0 &&
                      access(name.data(), F_OK) == 0;
  if (master >= 0) close(master);
  return usable;
}

std::unique_ptr<PtyPort> PtyPort::make() {
  const int master = openMaster();
  GYRE_CHECK(master >= 0);
  std::array<char, 64> name{};
  GYRE_CHECK(ptsname_r(master, name.data(), name.size()) == 0);
  // Only a terminal that was open once says that it is closed (POLLHUP).
  close(open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  return std::unique_ptr<PtyPort>(new PtyPort(master, name.data()));
}

PtyPort::~PtyPort() { close(master_); }

Result<std::size_t> PtyPort::read(std::span<std::byte> buffer, double timeout_s) {
  pollfd entry{master_, POLLIN, 0};
  poll(&entry, 1, open_ ? static_cast<int>(std::ceil(timeout_s * 1000.0)) : 0);
  const bool is_open = (entry.revents & POLLHUP) == 0;
  if (is_open && !std::exchange(open_, true) && opened_) opened_();
  open_ = is_open;
  const ssize_t count =
      (entry.revents & POLLIN) != 0 ? ::read(master_, buffer.data(), buffer.size()) : ssize_t{0};
  if (count > 0) return static_cast<std::size_t>(count);
  if (!is_open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return std::size_t{0};
}

Result<void> PtyPort::write(std::span<const std::byte> bytes, double timeout_s) {
  if (!open_) return {};
  while (!bytes.empty()) {
    const ssize_t count = ::write(master_, bytes.data(), bytes.size());
    if (count > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      continue;
    }
    pollfd entry{master_, POLLOUT, 0};
    const bool room =
        poll(&entry, 1, static_cast<int>(timeout_s * 1000.0)) > 0 && (entry.revents & POLLHUP) == 0;
    if (!room) return Error{Error::Code::kTimeout, "Nobody reads " + path_ + ".", ""};
  }
  return {};
}

}  // namespace gyre
