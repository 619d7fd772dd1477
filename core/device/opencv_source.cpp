// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/opencv_source.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <regex>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/clock.h"
#include "core/device/v4l2_controls.h"

namespace gyre {
namespace {

constexpr std::size_t kModesTold = 8;

Error notACamera(const std::string& camera) {
  return {Error::Code::kNotFound, "There is no camera \"" + camera + "\".",
          "`gyre devices` lists the cameras; give a number, a /dev/video path, an address "
          "(http://, rtsp://), gphoto:, a folder of pictures or a video."};
}

class OpenCvSource final : public FrameSource {
 public:
  OpenCvSource(const cv::VideoCapture& capture, std::unique_ptr<V4l2Device> device, CameraInfo info,
               int mains_hz)
      : capture_(capture), device_(std::move(device)), info_(std::move(info)) {
    lock_.mains_hz = mains_hz;
  }

  Result<void> grab(double timeout_s) override;
  Result<Frame> retrieve() override;
  CameraInfo lockControls() override {
    info_.controls = lockV4l2Controls(*device_, lock_);
    return info_;
  }
  CameraInfo readControls() override {
    info_.controls = readV4l2Controls(*device_);
    return info_;
  }
  CameraInfo info() const override { return info_; }

 private:
  Error gone() const;

  cv::VideoCapture capture_;
  std::unique_ptr<V4l2Device> device_;
  CameraInfo info_;
  V4l2LockOptions lock_;
  double grabbed_s_ = 0.0;
};

Error OpenCvSource::gone() const {
  return {Error::Code::kGone, "The camera " + info_.description + " gives no pictures any more.",
          "Check its cable and start again; what was captured is kept."};
}

Result<void> OpenCvSource::grab(double timeout_s) try {
  // grab() of a driver waits ten seconds; asked beforehand, it returns at once.
  std::vector<int> ready;
  const auto timeout_ns = static_cast<std::int64_t>(timeout_s * 1e9);
  if (!cv::VideoCapture::waitAny({capture_}, ready, timeout_ns)) {
    v4l2_capability question{};
    if (device_->ask(VIDIOC_QUERYCAP, &question) == ENODEV) return gone();
    return Error{Error::Code::kTimeout, "The camera gave no picture yet.", ""};
  }
  if (ready.empty() || !capture_.grab()) return gone();
  grabbed_s_ = steadySeconds();
  return {};
} catch (const cv::Exception&) {
  return gone();
}

Result<Frame> OpenCvSource::retrieve() try {
  Frame frame;
  frame.time_s = grabbed_s_;
  cv::Mat decoded;
  if (!capture_.retrieve(decoded) || decoded.empty()) {
    return Error{Error::Code::kIo, "A picture of the camera could not be decoded.",
                 "Check the cable, or choose another picture format."};
  }
  if (decoded.channels() == 1) {
    cv::cvtColor(decoded, frame.image_bgr, cv::COLOR_GRAY2BGR);
  } else {
    frame.image_bgr = decoded.clone();  // the capture keeps and overwrites its own
  }
  return frame;
} catch (const cv::Exception& problem) {
  return Error{Error::Code::kIo, "A picture of the camera could not be decoded: " + problem.err,
               "Choose another picture format."};
}

Error noSuchMode(std::span<const VideoMode> modes) {
  const std::string there_are = modesText(modes, kModesTold);
  return {Error::Code::kRejected, "The camera does not offer the mode that was asked for.",
          there_are.empty() ? "Leave the mode out."
                            : "Leave the mode out, or choose one of: " + there_are + "."};
}

// What a property says when it is set cannot be relied on from one version of OpenCV to the next,
// and a width counts only together with its height: the device is asked afterwards.
void askFor(cv::VideoCapture& capture, const VideoMode& mode) {
  const std::string& letters = mode.pixel_format;
  if (letters.size() == 4) {
    capture.set(cv::CAP_PROP_FOURCC,
                cv::VideoWriter::fourcc(letters[0], letters[1], letters[2], letters[3]));
  }
  if (mode.width_px > 0) {
    capture.set(cv::CAP_PROP_FRAME_WIDTH, mode.width_px);
    capture.set(cv::CAP_PROP_FRAME_HEIGHT, mode.height_px);
  }
  if (mode.frames_per_s > 0.0) capture.set(cv::CAP_PROP_FPS, mode.frames_per_s);
  capture.set(cv::CAP_PROP_CONVERT_RGB, 1.0);
}

std::string nameOf(V4l2Device& device, const std::string& path) {
  v4l2_capability answer{};
  if (device.ask(VIDIOC_QUERYCAP, &answer) != 0) return path;
  std::string card(std::begin(answer.card), std::end(answer.card));
  card.resize(std::min(card.find('\0'), card.size()));
  return card.empty() ? path : card + " (" + path + ")";
}

// As cameraModeFromText() reads it. Rates below one a second are none that can be asked for.
std::string wordOf(const VideoMode& mode) {
  const long rate = std::lround(mode.frames_per_s);
  return rate > 0 ? mode.text() + "@" + std::to_string(rate) : mode.text();
}

Result<std::unique_ptr<FrameSource>> openDevice(const std::string& path,
                                                const OpenCvSourceOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::is_character_file(path, ignored)) return notACamera(path);
  auto device = openV4l2Device(path);
  if (!device) return device.error();
  const std::vector<VideoMode> modes = listModes(**device);
  const auto mode = chooseMode(modes, options);
  if (!mode) return mode.error();
  cv::VideoCapture capture;
  if (!capture.open(path, cv::CAP_V4L2)) {
    return Error{Error::Code::kBusy, "The camera " + path + " could not be opened.",
                 "Close other programs that use it, or choose another /dev/video: some cameras "
                 "have several, and only one gives pictures."};
  }
  askFor(capture, *mode);
  const auto now = currentMode(**device);
  if (now && !keepsMode(*mode, *now)) return noSuchMode(modes);
  CameraInfo info;
  info.description = nameOf(**device, path);
  info.width_px = now ? now->width_px : mode->width_px;
  info.height_px = now ? now->height_px : mode->height_px;
  info.frames_per_s = now ? now->frames_per_s : mode->frames_per_s;
  if (now) info.mode = now->text();
  for (const VideoMode& offered : modes) info.modes.push_back(wordOf(offered));
  return std::unique_ptr<FrameSource>(std::make_unique<OpenCvSource>(
      capture, std::move(device).value(), std::move(info), options.mains_hz));
}

}  // namespace

Result<OpenCvSourceOptions> cameraModeFromText(const std::string& mode) {
  static const std::regex kMode(R"((\d{1,5})x(\d{1,5})(?:@([A-Za-z0-9]{4}))?(?:@(\d{1,3}))?)");
  std::smatch part;
  OpenCvSourceOptions options;
  const bool read = std::regex_match(mode, part, kMode);
  if (read) {
    options.width_px = std::stoi(part[1]);
    options.height_px = std::stoi(part[2]);
    options.pixel_format = part[3];
    if (part[4].matched) options.frames_per_s = std::stod(part[4]);
  }
  if (!read || options.width_px == 0 || options.height_px == 0) {
    return Error{Error::Code::kInvalidInput, "\"" + mode + "\" is not a camera mode.",
                 "Write it as 1920x1080, 1920x1080@MJPG or 1920x1080@MJPG@30."};
  }
  return options;
}

Result<VideoMode> chooseMode(std::span<const VideoMode> modes, const OpenCvSourceOptions& options) {
  VideoMode asked{options.width_px, options.height_px, options.pixel_format, options.frames_per_s};
  if (modes.empty()) return asked;  // the driver lists none: what it then reads back decides
  std::vector<VideoMode> fitting;
  for (VideoMode mode : modes) {
    if (asked.frames_per_s > 0.0) {
      if (mode.frames_per_s > 0.0 && mode.frames_per_s < asked.frames_per_s - 0.5) continue;
      mode.frames_per_s = asked.frames_per_s;
    }
    if (keepsMode(asked, mode)) fitting.push_back(mode);
  }
  const auto best = bestMode(fitting, options.least_frames_per_s);
  if (!best) return noSuchMode(modes);
  return *best;
}

bool keepsMode(const VideoMode& asked, const VideoMode& read_back) {
  const bool size = asked.width_px == 0 || (asked.width_px == read_back.width_px &&
                                            asked.height_px == read_back.height_px);
  return size && (asked.pixel_format.empty() || asked.pixel_format == read_back.pixel_format);
}

Result<std::unique_ptr<FrameSource>> openOpenCvSource(const std::string& camera,
                                                      const OpenCvSourceOptions& options) try {
  const bool index = !camera.empty() && camera.size() <= 3 &&
                     camera.find_first_not_of("0123456789") == std::string::npos;
  return openDevice(index ? "/dev/video" + camera : camera, options);
} catch (const cv::Exception& problem) {
  return Error{Error::Code::kInternal,
               "The camera " + camera + " could not be opened: " + problem.err,
               "Try another camera or mode."};
}

}  // namespace gyre
