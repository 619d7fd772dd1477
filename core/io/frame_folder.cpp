// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/frame_folder.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "core/base/check.h"
#include "core/io/file_bytes.h"
#include "core/io/natural_order.h"
#include "core/io/picture_file.h"

namespace gyre {
namespace {

bool isPictureName(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (name.starts_with('.')) return false;
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".tif" ||
         ending == ".tiff" || ending == ".bmp";
}

}  // namespace

Result<std::vector<std::filesystem::path>> listPictures(const std::filesystem::path& folder) {
  std::error_code problem;
  std::vector<std::filesystem::path> pictures;
  std::filesystem::directory_iterator entry(folder, problem);
  for (; !problem && entry != std::filesystem::directory_iterator(); entry.increment(problem)) {
    std::error_code ignored;
    if (isPictureName(entry->path()) && entry->is_regular_file(ignored)) {
      pictures.push_back(entry->path());
    }
  }
  if (problem) return fileError(problem.value(), "read", folder);
  if (pictures.empty()) {
    return Error{Error::Code::kNotFound, "There are no pictures in \"" + folder.string() + "\".",
                 "Give a folder with PNG, JPEG, TIFF or BMP files."};
  }
  std::sort(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
    return NaturalOrder()(a.filename().string(), b.filename().string());
  });
  return pictures;
}

Result<PictureSize> commonSize(std::span<const std::filesystem::path> pictures) {
  GYRE_CHECK(!pictures.empty());
  PictureSize first;
  for (const std::filesystem::path& picture : pictures) {
    const auto header = inspectPictureFile(picture);
    if (!header) return header.error();
    const PictureSize size{header->width_px, header->height_px};
    if (first.width_px == 0) first = size;
    if (size != first) {
      return Error{Error::Code::kInvalidInput,
                   "The pictures have different sizes: \"" + pictures.front().filename().string() +
                       "\" has " + first.text() + " pixels, \"" + picture.filename().string() +
                       "\" has " + size.text() + ".",
                   "Use pictures of one camera, taken with the same settings."};
    }
  }
  return first;
}

std::filesystem::path maskFor(const std::filesystem::path& picture,
                              const std::filesystem::path& mask_folder) {
  return mask_folder / (picture.stem().string() + ".png");
}

}  // namespace gyre
