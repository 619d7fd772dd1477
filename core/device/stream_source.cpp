// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/stream_source.h"

#include <chrono>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/address.h"
#include "core/base/clock.h"
#include "core/device/whole_jpeg.h"

namespace gyre {
namespace {

constexpr const char* kNoControls = "A stream has no controls; set it in the camera's own program.";
Error undecodable(const std::string& why) {
  return {Error::Code::kIo, "A picture of the network camera " + why + ".",
          "Check the network, or choose a smaller picture in the camera's own program."};
}

class StreamSource final : public FrameSource {
 public:
  StreamSource(std::string url, const StreamSourceOptions& options)
      : url_(std::move(url)), options_(options) {
    info_.description = withoutPassword(url_);
    for (const char* name : {"focus", "exposure", "gain", "white balance"}) {
      info_.controls.push_back({name, false, 0.0, kNoControls});
    }
  }

  Result<void> connect();
  Result<void> grab(double timeout_s) override;
  Result<Frame> retrieve() override;
  CameraInfo lockControls() override { return info_; }
  CameraInfo info() const override { return info_; }
  bool tellsEmptyQueue() const override { return false; }

 private:
  bool isJpegStream() const;
  Result<void> lost(double timeout_s) const;

  const std::string url_;
  const StreamSourceOptions options_;
  cv::VideoCapture capture_;
  bool packets_ = false;  // the capture hands out packets as they came
  CameraInfo info_;
  double grabbed_s_ = 0.0;
  double tried_s_ = 0.0;
};

bool StreamSource::isJpegStream() const {
  // The letters of the stream, or else the first four of the codec's name.
  const auto codec = static_cast<int>(capture_.get(cv::CAP_PROP_FOURCC));
  return codec == cv::VideoWriter::fourcc('M', 'J', 'P', 'G') ||
         codec == cv::VideoWriter::fourcc('m', 'j', 'p', 'g') ||
         codec == cv::VideoWriter::fourcc('m', 'j', 'p', 'e');
}

Result<void> StreamSource::connect() {
  const std::vector<int> parameters = {
      cv::CAP_PROP_OPEN_TIMEOUT_MSEC, static_cast<int>(options_.open_timeout_s * 1e3),
      cv::CAP_PROP_READ_TIMEOUT_MSEC, static_cast<int>(options_.read_timeout_s * 1e3)};
  const double start_s = steadySeconds();
  const bool opened = capture_.open(url_, cv::CAP_FFMPEG, parameters);
  tried_s_ = steadySeconds();
  if (!opened) {
    const bool late = tried_s_ - start_s >= 0.9 * options_.open_timeout_s;
    return Error{late ? Error::Code::kTimeout : Error::Code::kNotFound,
                 "The camera at " + withoutPassword(url_) +
                     (late ? " did not answer in time." : " could not be opened."),
                 "Open the same address in a browser to see whether it sends pictures."};
  }
  info_.width_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH));
  info_.height_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
  const double rate = capture_.get(cv::CAP_PROP_FPS);
  info_.frames_per_s = std::isfinite(rate) && rate > 0.0 ? rate : 0.0;
  packets_ = isJpegStream() && capture_.set(cv::CAP_PROP_FORMAT, -1);
  return {};
}

// While the connection is lost: what is wrong, after no more than the time-out.
Result<void> StreamSource::lost(double timeout_s) const {
  std::this_thread::sleep_for(std::chrono::duration<double>(timeout_s));
  return Error{Error::Code::kTimeout,
               "The camera at " + info_.description + " sends no pictures any more.",
               "Check that it is on and in the same network; it is looked for again and again. "
               "What was captured is kept."};
}

Result<void> StreamSource::grab(double timeout_s) try {
  if (!capture_.isOpened()) {
    if (steadySeconds() - tried_s_ < options_.retry_s || !connect()) return lost(timeout_s);
  }
  if (!capture_.grab()) {
    capture_.release();
    tried_s_ = steadySeconds();
    return lost(timeout_s);
  }
  grabbed_s_ = steadySeconds();
  return {};
} catch (const cv::Exception&) {
  capture_.release();
  return lost(timeout_s);
}

Result<Frame> StreamSource::retrieve() try {
  Frame frame;
  frame.time_s = grabbed_s_;
  cv::Mat got;
  if (!capture_.isOpened() || !capture_.retrieve(got) || got.empty()) {
    return undecodable("could not be decoded");
  }
  if (packets_) {
    if (!got.isContinuous()) got = got.clone();
    auto decoded = decodeWholeJpeg({got.data, got.total() * got.elemSize()});
    if (!decoded) return decoded.error();
    frame.image_bgr = std::move(decoded).value();
  } else if (got.channels() == 1) {
    cv::cvtColor(got, frame.image_bgr, cv::COLOR_GRAY2BGR);
  } else {
    frame.image_bgr = got.clone();  // the capture keeps and overwrites its own
  }
  return frame;
} catch (const cv::Exception& problem) {
  return undecodable("could not be decoded: " + problem.err);
}

}  // namespace

bool namesStream(const std::string& camera) { return camera.find("://") != std::string::npos; }

Result<std::unique_ptr<FrameSource>> openStreamSource(const std::string& url,
                                                      const StreamSourceOptions& options) try {
  if (lacksPassword(url)) {
    return Error{Error::Code::kNoPermission,
                 "The password of the camera " + url + " is stored nowhere.",
                 "Give its address once more with --camera, password and all."};
  }
  auto source = std::make_unique<StreamSource>(url, options);
  if (const auto connected = source->connect(); !connected) return connected.error();
  return std::unique_ptr<FrameSource>(std::move(source));
} catch (const cv::Exception& problem) {
  return Error{Error::Code::kInternal,
               "The camera " + withoutPassword(url) + " could not be opened: " + problem.err,
               "Try another camera."};
}

}  // namespace gyre
