// A folder of pictures, in the order in which people number them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/scan/picture_size.h"

namespace gyre {

// The folder's PNG, JPEG, TIFF and BMP files by their endings, in natural order. Hidden files are
// passed over. Fails when there is no such folder and when it holds no picture.
Result<std::vector<std::filesystem::path>> listPictures(const std::filesystem::path& folder);

// The size that all pictures share. Reads every file, so that a cut-off or differing picture is
// told before any work begins.
Result<PictureSize> commonSize(std::span<const std::filesystem::path> pictures);

// Where the mask of a picture lies: same stem, ending .png, in the folder of masks.
std::filesystem::path maskFor(const std::filesystem::path& picture,
                              const std::filesystem::path& mask_folder);

}  // namespace gyre
