// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/archive_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <locale.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/unique_fd.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece_bytes = std::size_t{16} << 10;
constexpr int kRights = 0644;

// Names are UTF-8 here whatever the user's country: the library asks this thread's locale.
class Utf8Names {
 public:
  Utf8Names()
      : utf8_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)),
        before_(utf8_ != nullptr ? uselocale(utf8_) : nullptr) {}
  Utf8Names(const Utf8Names&) = delete;
  Utf8Names& operator=(const Utf8Names&) = delete;
  ~Utf8Names() {
    if (utf8_ == nullptr) return;
    uselocale(before_);
    freelocale(utf8_);
  }

 private:
  locale_t utf8_;
  locale_t before_;
};

}  // namespace

struct ArchiveFile::State {
  fs::path file;
  fs::path beside;
  archive* pack = nullptr;
  UniqueFd fd;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    archive_write_free(pack);
    if (!beside.empty()) ::unlink(beside.c_str());
  }

  Error failure() const {
    const char* words = archive_error_string(pack);
    if (archive_errno(pack) == ENOSPC) return fileError(ENOSPC, "write", file);
    return {Error::Code::kIo,
            "\"" + file.string() + "\" cannot be packed (" +
                (words != nullptr ? words : "no reason given") + ").",
            "Look at the room on the disk, or write it elsewhere."};
  }
};

ArchiveFile::ArchiveFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
ArchiveFile::ArchiveFile(ArchiveFile&&) noexcept = default;
ArchiveFile& ArchiveFile::operator=(ArchiveFile&&) noexcept = default;
ArchiveFile::~ArchiveFile() = default;

Result<ArchiveFile> ArchiveFile::create(const fs::path& file) {
  const std::string name = file.filename().string();
  const bool zip = name.ends_with(".zip");
  if (!zip && !name.ends_with(".tar.gz") && !name.ends_with(".tgz")) {
    return Error{Error::Code::kInvalidInput, "\"" + name + "\" is no archive by its ending.",
                 "Use .tar.gz or .zip."};
  }
  auto state = std::make_unique<State>();
  state->file = file;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  state->beside = folder / ("." + std::to_string(::getpid()) + ".gyre-part");
  state->fd =
      UniqueFd(::open(state->beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!state->fd.valid()) {
    const int problem = errno;
    state->beside.clear();
    return fileError(problem, "write", file);
  }
  const Utf8Names utf8;
  state->pack = archive_write_new();
  int done = ARCHIVE_OK;
  if (zip) {
    done = archive_write_set_format_zip(state->pack);
    archive_write_set_options(state->pack, "zip:hdrcharset=UTF-8");
  } else {
    archive_write_add_filter_gzip(state->pack);
    done = archive_write_set_format_pax_restricted(state->pack);
  }
  if (done != ARCHIVE_OK || archive_write_open_fd(state->pack, state->fd.get()) != ARCHIVE_OK) {
    return state->failure();
  }
  return ArchiveFile(std::move(state));
}

Result<void> ArchiveFile::begin(const std::string& name, std::uintmax_t bytes) {
  archive_entry* entry = archive_entry_new();
  const Utf8Names utf8;
  archive_entry_set_pathname(entry, name.c_str());
  archive_entry_set_size(entry, static_cast<la_int64_t>(bytes));
  archive_entry_set_filetype(entry, AE_IFREG);
  archive_entry_set_perm(entry, kRights);
  archive_entry_set_mtime(entry, std::time(nullptr), 0);
  const int done = archive_write_header(state_->pack, entry);
  archive_entry_free(entry);
  if (done < ARCHIVE_WARN) return state_->failure();
  return {};
}

Result<void> ArchiveFile::add(const std::string& name, std::string_view bytes) {
  if (const auto begun = begin(name, bytes.size()); !begun) return begun;
  if (archive_write_data(state_->pack, bytes.data(), bytes.size()) !=
      static_cast<la_ssize_t>(bytes.size())) {
    return state_->failure();
  }
  return {};
}

Result<void> ArchiveFile::addFile(const std::string& name, const fs::path& file) {
  std::error_code failed;
  std::uintmax_t left = fs::file_size(file, failed);
  if (failed) return fileError(failed.value(), "read", file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fileError(errno, "read", file);
  if (const auto begun = begin(name, left); !begun) return begun;
  // As many bytes as were announced: a log may grow meanwhile.
  std::array<char, kPiece_bytes> piece{};
  while (left > 0) {
    const auto wanted = static_cast<std::streamsize>(std::min<std::uintmax_t>(left, piece.size()));
    stream.read(piece.data(), wanted);
    if (stream.gcount() != wanted) {
      return Error{Error::Code::kIo,
                   "\"" + file.string() + "\" became shorter while it was packed.",
                   "Try again when nothing writes to it."};
    }
    const auto count = static_cast<std::size_t>(wanted);
    if (archive_write_data(state_->pack, piece.data(), count) != static_cast<la_ssize_t>(count)) {
      return state_->failure();
    }
    left -= count;
  }
  return {};
}

Result<void> ArchiveFile::finish() {
  if (archive_write_close(state_->pack) != ARCHIVE_OK) return state_->failure();
  if (::fsync(state_->fd.get()) != 0 || !state_->fd.close()) {
    return fileError(errno, "write", state_->file);
  }
  if (::rename(state_->beside.c_str(), state_->file.c_str()) != 0) {
    return fileError(errno, "write", state_->file);
  }
  state_->beside.clear();
  const fs::path& file = state_->file;
  return syncFolder(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

}  // namespace gyre
