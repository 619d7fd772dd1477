// A video file in the place of a camera.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "core/device/recorded_camera.h"

namespace gyre {

// Any thread may call any member. Pictures come as they were recorded, turned by no tag of the
// file. kInvalidInput when the file ends before the pictures that it tells of.
// Fails to open, with the reason, what is no file, empty, or no video: kNotFound, kNoPermission,
// kInvalidInput.
Result<std::unique_ptr<RecordedCamera>> openVideoFile(const std::filesystem::path& file);

}  // namespace gyre
