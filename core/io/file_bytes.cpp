// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/io/unique_fd.h"

namespace gyre {
namespace {

Error notAFile(const std::filesystem::path& file, bool is_folder) {
  return {Error::Code::kInvalidInput,
          "Cannot read \"" + file.string() + "\": it is " +
              (is_folder ? "a folder." : "no ordinary file."),
          "Give the name of a file."};
}

}  // namespace

bool isThere(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

Error fileError(int error_number, const std::string& doing, const std::filesystem::path& file) {
  const std::string what = "Cannot " + doing + " \"" + file.string() + "\": ";
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return {Error::Code::kNotFound, what + "there is no such file or folder.",
              "Check the name and the folder."};
    case EACCES:
    case EPERM:
      return {Error::Code::kNoPermission, what + "permission denied.",
              "Choose a place that belongs to you, or change the permissions."};
    case EROFS:
      return {Error::Code::kNoPermission, what + "the disk can only be read.",
              "Choose a place on another disk."};
    case ENOSPC:
    case EDQUOT:
      return {Error::Code::kNoSpace, what + "the disk is full.",
              "Free some space or choose another disk, then try again."};
    case ENAMETOOLONG:
      return {Error::Code::kInvalidInput, what + "the name is too long.", "Choose a shorter name."};
    default:
      return {Error::Code::kIo, what + std::generic_category().message(error_number) + ".",
              "Check the disk and its connection, then try again."};
  }
}

Result<std::string> readFileBytes(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  // Without O_NONBLOCK, opening a named pipe would wait for ever.
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!fd.valid()) return fileError(errno, "read", file);
  struct stat status {};
  if (::fstat(fd.get(), &status) != 0) return fileError(errno, "read", file);
  if (!S_ISREG(status.st_mode)) return notAFile(file, S_ISDIR(status.st_mode));
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > max_bytes) {
    return Error{Error::Code::kInvalidInput,
                 "The file \"" + file.string() +
                     "\" is too large for what it should be: " + std::to_string(size) + " bytes.",
                 "Check that it is the right file."};
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(fd.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fileError(errno, "read", file);
    if (got == 0) break;  // it became shorter meanwhile
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace gyre
