// Packs files into one archive that every system opens: .tar.gz or .zip.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace gyre {

// One thread at a time. Until finish() the archive has another name, and destroying it leaves
// nothing behind.
class ArchiveFile {
 public:
  // By the file's ending: .tar.gz, .tgz or .zip. kInvalidInput for another.
  static Result<ArchiveFile> create(const std::filesystem::path& file);
  ArchiveFile(ArchiveFile&&) noexcept;
  ArchiveFile& operator=(ArchiveFile&&) noexcept;
  ~ArchiveFile();

  // name: in the archive, with "/" between folders, UTF-8.
  Result<void> add(const std::string& name, std::string_view bytes);
  // A file of any size, read piece by piece. Its failure to be read is told; the archive stays good
  // as long as nothing of the file was packed yet.
  Result<void> addFile(const std::string& name, const std::filesystem::path& file);

  // Writes the end, syncs, and gives the archive its name, replacing a file that had it.
  Result<void> finish();

 private:
  struct State;
  explicit ArchiveFile(std::unique_ptr<State> state);
  Result<void> begin(const std::string& name, std::uintmax_t bytes);

  std::unique_ptr<State> state_;
};

}  // namespace gyre
