// Finds the pictures that a result was made from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gyre {

// Where the pictures of the result in a folder lie: in its own frames/, or where report.json says
// that it was made from; those of a merged result with its passes. Reads what it needs once.
// Thread: any.
class PictureFinder {
 public:
  // named: where they are to be looked for instead, unless empty.
  explicit PictureFinder(const std::filesystem::path& result_folder,
                         const std::filesystem::path& named = {});

  // The file of a view's picture (ResultView::picture); empty when it is not found.
  std::filesystem::path find(const std::string& picture) const;

 private:
  struct Place {
    std::string before;                          // of the picture's name: "" or "pass-2/"
    std::vector<std::filesystem::path> folders;  // in the order in which to look
  };
  std::vector<Place> places_;
};

// The picture of the first view of the result in a folder; empty when it is not found.
std::filesystem::path firstPictureOf(const std::filesystem::path& folder);

}  // namespace gyre
