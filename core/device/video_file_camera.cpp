// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/video_file_camera.h"

#include <unistd.h>

#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/clock.h"

namespace gyre {
namespace {

// Containers tell lengths and rates, and the number of pictures is computed from them: it may be
// off by this many, and by this share.
constexpr double kCountSlack = 2.0;
constexpr double kCountSlackShare = 0.01;

std::string quoted(const std::filesystem::path& file) { return "\"" + file.string() + "\""; }

class VideoFileCamera final : public RecordedCamera {
 public:
  VideoFileCamera(std::filesystem::path file, const cv::VideoCapture& capture)
      : file_(std::move(file)), capture_(capture) {
    info_.description = "the video " + file_.filename().string();
    info_.width_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH));
    info_.height_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
    told_pictures_ = capture_.get(cv::CAP_PROP_FRAME_COUNT);
  }

  Result<FramePtr> grabAfter(double time_s, const Task& task) override;
  Result<CameraInfo> lockControls() override { return info_; }
  CameraInfo info() const override { return info_; }
  void goTo(std::size_t index) override;

 private:
  Result<void> skipTo(std::size_t index, const Task& task);
  Error ended() const;

  const std::filesystem::path file_;
  CameraInfo info_;
  double told_pictures_ = 0.0;

  std::mutex mutex_;  // guards what follows
  cv::VideoCapture capture_;
  std::size_t decoded_ = 0;  // pictures taken from the file so far
  std::size_t next_ = 0;
  FramePtr present_;
};

Error VideoFileCamera::ended() const {
  const auto count = static_cast<double>(decoded_);
  const double slack = kCountSlack + kCountSlackShare * told_pictures_;
  if (count + slack < told_pictures_) {
    return {Error::Code::kInvalidInput,
            "The video " + quoted(file_) + " is cut off: it tells of " +
                std::to_string(static_cast<long>(told_pictures_)) + " pictures and holds " +
                std::to_string(decoded_) + ".",
            "Copy it from the camera again."};
  }
  return {Error::Code::kNotFound,
          "All " + std::to_string(decoded_) + " pictures of the video are used.",
          "Ask for as many views as there are pictures, or fewer."};
}

Result<void> VideoFileCamera::skipTo(std::size_t index, const Task& task) {
  if (index < decoded_) {  // pictures lie in the file as differences: it is read from its start
    if (!capture_.open(file_.string(), cv::CAP_FFMPEG)) return ended();
    capture_.set(cv::CAP_PROP_ORIENTATION_AUTO, 0.0);
    decoded_ = 0;
  }
  for (; decoded_ < index; ++decoded_) {
    if (task.stopRequested()) return cancelled();
    if (!capture_.grab()) return ended();
  }
  return {};
}

Result<FramePtr> VideoFileCamera::grabAfter(double time_s, const Task& task) try {
  if (task.stopRequested()) return cancelled();
  const std::scoped_lock lock(mutex_);
  if (present_ && time_s <= present_->time_s) return present_;
  if (const auto there = skipTo(next_, task); !there) return there.error();
  cv::Mat picture;
  if (!capture_.read(picture) || picture.empty()) return ended();
  ++decoded_;
  ++next_;
  Frame frame;
  frame.time_s = steadySeconds();
  if (picture.channels() == 1) {
    cv::cvtColor(picture, frame.image_bgr, cv::COLOR_GRAY2BGR);
  } else {
    frame.image_bgr = picture.clone();  // the capture keeps and overwrites its own
  }
  present_ = std::make_shared<const Frame>(std::move(frame));
  return present_;
} catch (const cv::Exception& problem) {
  return Error{Error::Code::kInvalidInput,
               "A picture of the video " + quoted(file_) + " cannot be read: " + problem.err,
               "Copy it from the camera again, or convert it to MP4."};
}

void VideoFileCamera::goTo(std::size_t index) {
  const std::scoped_lock lock(mutex_);
  next_ = index;
  present_.reset();
}

}  // namespace

Result<std::unique_ptr<RecordedCamera>> openVideoFile(const std::filesystem::path& file) try {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem)) {
    return Error{Error::Code::kNotFound, "There is no video " + quoted(file) + ".",
                 "Check the name and the folder."};
  }
  if (::access(file.c_str(), R_OK) != 0) {
    return Error{Error::Code::kNoPermission, "You may not read the video " + quoted(file) + ".",
                 "Change its permissions, or copy it to a folder of yours."};
  }
  if (std::filesystem::file_size(file, problem) == 0) {
    return Error{Error::Code::kInvalidInput, "The video " + quoted(file) + " is empty.",
                 "Copy it from the camera again."};
  }
  // Read as a file of that very name: "%" in it is no pattern of numbered pictures.
  cv::VideoCapture capture;
  if (!capture.open(file.string(), cv::CAP_FFMPEG)) {
    return Error{Error::Code::kInvalidInput,
                 "The file " + quoted(file) + " cannot be read as a video.",
                 "It may be cut off, or no video at all: play it in a video player to see."};
  }
  capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0.0);
  return std::unique_ptr<RecordedCamera>(std::make_unique<VideoFileCamera>(file, capture));
} catch (const cv::Exception& failed) {
  return Error{Error::Code::kInvalidInput,
               "The video " + quoted(file) + " cannot be read: " + failed.err,
               "Convert it to MP4."};
}

}  // namespace gyre
