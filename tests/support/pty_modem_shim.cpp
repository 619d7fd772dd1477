// Stands between libserialport and the system for pseudo terminals only: libserialport refuses a
// port without an entry under /sys/class/tty and without modem lines, and a pseudo terminal has
// neither. Linked into a test program with ENABLE_EXPORTS; everything else passes through.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <cstring>
#include <string_view>

// The declarations of the system headers differ in noexcept and attributes: these are their twins.
extern "C" {
int ioctl(int fd, unsigned long request, ...) noexcept;
int __lxstat(int version, const char* path, struct stat* status) noexcept;  // NOLINT(bugprone-*)
}

namespace {

constexpr unsigned long kGetModemLines = 0x5415;   // TIOCMGET
constexpr unsigned long kSetModemBits = 0x5416;    // TIOCMBIS
constexpr unsigned long kClearModemBits = 0x5417;  // TIOCMBIC
constexpr unsigned long kSetModemLines = 0x5418;   // TIOCMSET
constexpr unsigned kFirstPtyMajor = 136;
constexpr unsigned kLastPtyMajor = 143;

bool isPty(int fd) {
  struct stat status {};
  if (fstat(fd, &status) != 0) return false;
  const unsigned number = major(status.st_rdev);
  return S_ISCHR(status.st_mode) && number >= kFirstPtyMajor && number <= kLastPtyMajor;
}

bool isPtyEntry(const char* path) {
  return std::string_view(path).starts_with("/sys/class/tty/pts/");
}

}  // namespace

extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  const bool modem = request == kGetModemLines || request == kSetModemBits ||
                     request == kClearModemBits || request == kSetModemLines;
  if (modem && isPty(fd)) {
    if (request == kGetModemLines) *static_cast<int*>(argument) = 0;
    return 0;
  }
  return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}

extern "C" int __lxstat(int, const char* path, struct stat* status) noexcept {
  if (!isPtyEntry(path)) return fstatat(AT_FDCWD, path, status, AT_SYMLINK_NOFOLLOW);
  *status = {};
  status->st_mode = S_IFLNK | 0777;
  return 0;
}

extern "C" ssize_t readlink(const char* path, char* buffer, size_t size) noexcept {
  if (!isPtyEntry(path)) return syscall(SYS_readlinkat, AT_FDCWD, path, buffer, size);
  constexpr std::string_view kTarget = "../../devices/platform/pty/tty/pts";
  const std::size_t length = std::min(size, kTarget.size());
  std::memcpy(buffer, kTarget.data(), length);
  return static_cast<ssize_t>(length);
}
