// Finds the pictures that a result was made from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gyre {

// The folders in which the pictures of the result in a folder may lie: its own frames/, and what
// report.json says it was made from. In the order in which to look.
std::vector<std::filesystem::path> pictureFoldersOf(const std::filesystem::path& folder);

// The first of the folders' files of that name; empty when there is none.
std::filesystem::path findPicture(const std::vector<std::filesystem::path>& folders,
                                  const std::string& name);

// The picture of the first view of the result in a folder; empty when it is not found.
std::filesystem::path firstPictureOf(const std::filesystem::path& folder);

}  // namespace gyre
