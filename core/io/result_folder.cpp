// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/result_folder.h"

#include <string>
#include <system_error>

#include "core/io/atomic_file.h"

namespace gyre {

Result<void> makeResultFolder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) {
    return Error{
        Error::Code::kIo,
        "The folder \"" + folder.string() + "\" cannot be made: " + problem.message() + ".",
        "Choose a folder in which you may write."};
  }
  const std::filesystem::path trial = folder / ".gyre-trial";
  const auto written = writeFileAtomically(trial, std::string());
  std::filesystem::remove(trial, problem);
  return written;
}

}  // namespace gyre
