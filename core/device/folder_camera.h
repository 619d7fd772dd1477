// A folder of pictures in the place of a camera: each later moment shows the next one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <vector>

#include "core/device/recorded_camera.h"

namespace gyre {

// Reads one picture as 8-bit BGR; core/io knows how.
using PictureReader = std::function<Result<cv::Mat>(const std::filesystem::path&)>;

// Any thread.
class FolderCamera final : public RecordedCamera {
 public:
  // pictures: in the order in which they were taken.
  FolderCamera(std::vector<std::filesystem::path> pictures, PictureReader reader);

  Result<FramePtr> grabAfter(double time_s, const Task& task) override;
  Result<CameraInfo> lockControls() override { return info(); }
  CameraInfo info() const override;

  void goTo(std::size_t index) override;

 private:
  const std::vector<std::filesystem::path> pictures_;
  const PictureReader reader_;
  mutable std::mutex mutex_;
  std::size_t next_ = 0;
  FramePtr present_;
  CameraInfo info_;
};

}  // namespace gyre
