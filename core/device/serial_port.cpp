// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/serial_port.h"

#include <grp.h>
#include <libserialport.h>
#include <pwd.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

namespace gyre {
namespace {

std::string userName() {
  const passwd* entry = getpwuid(geteuid());
  return entry != nullptr ? entry->pw_name : "$USER";
}

std::string groupOf(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return "dialout";
  const group* entry = getgrgid(status.st_gid);
  return entry != nullptr ? entry->gr_name : "dialout";
}

Error noPermission(const std::string& path) {
  // A device file of group root (some containers and udev rules) is no reason to join root.
  const std::string owner = groupOf(path);
  const std::string group = owner == "root" ? "dialout" : owner;
  return {Error::Code::kNoPermission,
          "You may not open " + path + ": your user is not in the group " + group + ".",
          "Run \"sudo usermod -aG " + group + " " + userName() + "\", then log out and in again."};
}

Error busy(const std::string& path) {
  return {Error::Code::kBusy, path + " is in use by another program.",
          "Close it (a serial monitor, a printer host, or ModemManager just after plugging in), "
          "then try again."};
}

Error openError(const std::string& path, int error_number) {
  switch (error_number) {
    case EACCES:
    case EPERM:
      return noPermission(path);
    case EBUSY:
      return busy(path);
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return {Error::Code::kNotFound, "There is no device at " + path + ".",
              "Plug it in and look at the list of ports."};
    default:
      return {Error::Code::kIo,
              path + " cannot be opened (" + std::system_category().message(error_number) + ").",
              "Unplug it, plug it in again, and try once more."};
  }
}

// 8N1, no flow control. DTR and RTS both on: boards that use the pair to reset let go then.
bool configure(sp_port* port, int baud) {
  return sp_set_baudrate(port, baud) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
         sp_set_parity(port, SP_PARITY_NONE) == SP_OK && sp_set_stopbits(port, 1) == SP_OK &&
         sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK &&
         sp_set_dtr(port, SP_DTR_ON) == SP_OK && sp_set_rts(port, SP_RTS_ON) == SP_OK;
}

// libserialport takes no symbolic links and counts milliseconds, 0 being for ever.
unsigned milliseconds(double seconds) {
  return static_cast<unsigned>(std::clamp(std::ceil(seconds * 1000.0), 1.0, 1e9));
}

}  // namespace

std::optional<Error> portError(const std::string& path) {
  if (access(path.c_str(), R_OK | W_OK) == 0) return std::nullopt;
  return openError(path, errno);
}

std::string portHindrance(const std::string& path) {
  const std::optional<Error> error = portError(path);
  return error ? error->sentence() : "";
}

SerialPort::SerialPort(sp_port* port, std::string path) : port_(port), path_(std::move(path)) {}

SerialPort::~SerialPort() {
  sp_close(port_);
  sp_free_port(port_);
}

Result<std::unique_ptr<SerialPort>> SerialPort::open(const std::string& path, int baud) {
  std::error_code failed;
  const std::filesystem::path device = std::filesystem::canonical(path, failed);
  if (failed) return openError(path, failed.value());
  if (access(device.c_str(), R_OK | W_OK) != 0) return openError(path, errno);
  sp_port* port = nullptr;
  if (sp_get_port_by_name(device.c_str(), &port) != SP_OK) {
    return Error{Error::Code::kInvalidInput, path + " is no serial port.",
                 "Look at the list of ports."};
  }
  if (sp_open(port, SP_MODE_READ_WRITE) != SP_OK) {
    const int error_number = sp_last_error_code();
    sp_free_port(port);
    return openError(path, error_number);
  }
  std::unique_ptr<SerialPort> opened(new SerialPort(port, path));
  int handle = -1;
  // The lock keeps out other programs that ask for it; TIOCEXCL those that do not, but for root.
  if (sp_get_port_handle(port, &handle) != SP_OK || flock(handle, LOCK_EX | LOCK_NB) != 0) {
    return busy(path);
  }
  ioctl(handle, TIOCEXCL);
  if (!configure(port, baud)) return openError(path, sp_last_error_code());
  sp_flush(port, SP_BUF_BOTH);
  return opened;
}

Error SerialPort::gone() const {
  return {Error::Code::kGone,
          path_ + " has vanished: the cable was pulled or the board lost power.",
          "Plug it in, then connect again."};
}

Result<std::size_t> SerialPort::read(std::span<std::byte> buffer, double timeout_s) {
  const sp_return count =
      sp_blocking_read_next(port_, buffer.data(), buffer.size(), milliseconds(timeout_s));
  if (count > 0) return static_cast<std::size_t>(count);
  // After an unplug a read gives nothing, as after a time-out; only this tells them apart.
  if (count < 0 || sp_input_waiting(port_) < 0) return gone();
  return std::size_t{0};
}

Result<void> SerialPort::write(std::span<const std::byte> bytes, double timeout_s) {
  const sp_return count =
      sp_blocking_write(port_, bytes.data(), bytes.size(), milliseconds(timeout_s));
  if (count < 0) return gone();
  if (static_cast<std::size_t>(count) < bytes.size()) {
    return Error{Error::Code::kTimeout, path_ + " takes no more data.",
                 "Check the board's power, then connect again."};
  }
  return {};
}

}  // namespace gyre
