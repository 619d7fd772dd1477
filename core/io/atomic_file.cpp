// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/io/file_bytes.h"
#include "core/io/unique_fd.h"

namespace gyre {
namespace {

constexpr std::string_view kUnfinished = ".gyre-part";

// Opens a file of its own beside the one to be replaced: no other process uses its number, and
// O_EXCL passes over what a killed one with the same number left.
UniqueFd openBeside(const std::filesystem::path& file, std::filesystem::path& beside) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    // The file's own name is left out: beside a name of full length there is room for no longer.
    std::string name(1, '.');
    name.append(std::to_string(::getpid())).append("-").append(std::to_string(attempt));
    beside = file.parent_path() / name.append(kUnfinished);
    UniqueFd fd(::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (fd.valid() || errno != EEXIST) return fd;
  }
  return {};
}

// Returns 0 or the error number.
int writeAndSync(UniqueFd& fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(fd.get()) != 0) return errno;
  return fd.close() ? 0 : errno;
}

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

Result<void> writeFileAtomically(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path beside;
  UniqueFd fd = openBeside(file, beside);
  if (!fd.valid()) return fileError(errno, "write", file);
  int problem = writeAndSync(fd, bytes);
  if (problem == 0 && ::rename(beside.c_str(), file.c_str()) != 0) problem = errno;
  if (problem != 0) {
    ::unlink(beside.c_str());
    return fileError(problem, "write", file);
  }
  return syncFolder(folderOf(file));
}

Result<void> syncFolder(const std::filesystem::path& folder) {
  const UniqueFd fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd.valid()) return fileError(errno, "write", folder);
  // EINVAL: a file system that knows no syncing of folders keeps them safe in its own way.
  if (::fsync(fd.get()) != 0 && errno != EINVAL) return fileError(errno, "write", folder);
  return {};
}

void removeUnfinishedFiles(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::directory_iterator entry(folder, ignored);
  for (; !ignored && entry != std::filesystem::directory_iterator(); entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    std::error_code remains;
    if (name.starts_with('.') && name.ends_with(kUnfinished)) {
      std::filesystem::remove(entry->path(), remains);
    }
  }
}

}  // namespace gyre
