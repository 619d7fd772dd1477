// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/folder_camera.h"

#include <string>
#include <utility>

#include "core/base/check.h"
#include "core/base/clock.h"

namespace gyre {

FolderCamera::FolderCamera(std::vector<std::filesystem::path> pictures, PictureReader reader)
    : pictures_(std::move(pictures)), reader_(std::move(reader)) {
  GYRE_CHECK(reader_ != nullptr);
  info_.description = std::to_string(pictures_.size()) + " pictures in a folder";
}

Result<FramePtr> FolderCamera::grabAfter(double time_s, const Task& task) {
  if (task.stopRequested()) return cancelled();
  const std::scoped_lock lock(mutex_);
  if (present_ && time_s <= present_->time_s) return present_;
  if (next_ >= pictures_.size()) {
    return Error{Error::Code::kNotFound,
                 "All " + std::to_string(pictures_.size()) + " pictures of the folder are used.",
                 "Ask for as many views as there are pictures, or fewer."};
  }
  const std::filesystem::path& picture = pictures_[next_];
  Result<cv::Mat> image = reader_(picture);
  if (!image) return image.error();
  Frame frame;
  frame.name = picture.filename().string();
  frame.time_s = steadySeconds();
  frame.image_bgr = std::move(image).value();
  info_.width_px = frame.image_bgr.cols;
  info_.height_px = frame.image_bgr.rows;
  ++next_;
  present_ = std::make_shared<const Frame>(std::move(frame));
  return present_;
}

CameraInfo FolderCamera::info() const {
  const std::scoped_lock lock(mutex_);
  return info_;
}

void FolderCamera::goTo(std::size_t index) {
  const std::scoped_lock lock(mutex_);
  next_ = index;
  present_.reset();
}

}  // namespace gyre
