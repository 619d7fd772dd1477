// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/v4l2_device.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gyre {
namespace {

class OpenV4l2Device final : public V4l2Device {
 public:
  explicit OpenV4l2Device(int fd) : fd_(fd) {}
  ~OpenV4l2Device() override { ::close(fd_); }
  OpenV4l2Device(const OpenV4l2Device&) = delete;
  OpenV4l2Device& operator=(const OpenV4l2Device&) = delete;

  int ask(unsigned long request, void* structure) override {
    int answer = 0;
    do {
      answer = ::ioctl(fd_, request, structure);
    } while (answer != 0 && errno == EINTR);
    return answer == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

}  // namespace

Result<std::unique_ptr<V4l2Device>> openV4l2Device(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (fd >= 0) return std::unique_ptr<V4l2Device>(std::make_unique<OpenV4l2Device>(fd));
  const int problem = errno;
  const std::string what = "The camera " + path +
                           " could not be opened: " + std::generic_category().message(problem) +
                           ".";
  if (problem == ENOENT || problem == ENODEV || problem == ENXIO) {
    return Error{Error::Code::kNotFound, what, "Plug it in; `gyre devices` lists the cameras."};
  }
  if (problem == EACCES || problem == EPERM) {
    return Error{Error::Code::kNoPermission, what,
                 "Run `sudo usermod -aG video $USER`, then log out and in again."};
  }
  return Error{Error::Code::kIo, what, "Unplug the camera, plug it in again and try once more."};
}

}  // namespace gyre
