// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/opencv_source.h"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <regex>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/address.h"
#include "core/base/clock.h"

namespace gyre {
namespace {

bool isUrl(const std::string& camera) { return camera.find("://") != std::string::npos; }

Error notACamera(const std::string& camera) {
  return {Error::Code::kNotFound, "There is no camera \"" + withoutPassword(camera) + "\".",
          "`gyre devices` lists the cameras; give its number, its /dev/video path, or a URL."};
}

int fourccFromText(const std::string& text) {
  return cv::VideoWriter::fourcc(text[0], text[1], text[2], text[3]);
}

// The control with its automatic counterpart. OpenCV hands V4L2 numbers through, so the meaning of
// automatic exposure changed between its versions: 0.25, 1, or 3 and then 1 have all meant manual.
// Each is tried until the driver keeps it; only what is read back counts.
struct Control {
  const char* name;
  int value;
  int automatic;
  std::vector<double> manual;  // values of `automatic` that may mean manual, best first
};

const std::vector<Control>& controls() {
  static const std::vector<Control> kControls = {
      {"focus", cv::CAP_PROP_FOCUS, cv::CAP_PROP_AUTOFOCUS, {0.0}},
      {"exposure", cv::CAP_PROP_EXPOSURE, cv::CAP_PROP_AUTO_EXPOSURE, {1.0, 0.25}},
      {"gain", cv::CAP_PROP_GAIN, -1, {}},
      {"white balance", cv::CAP_PROP_WB_TEMPERATURE, cv::CAP_PROP_AUTO_WB, {0.0}},
  };
  return kControls;
}

// OpenCV answers -1 or 0 for what a driver does not know, and tells neither from a value.
bool known(double value) { return std::isfinite(value) && value > 0.0; }

ControlState lockControl(cv::VideoCapture& capture, const Control& control) {
  ControlState state{control.name, false, capture.get(control.value), ""};
  if (!known(state.value)) {
    state.remark = "The camera does not offer it to programs; set it on the camera itself.";
    return state;
  }
  bool manual = control.automatic < 0;
  for (const double value : control.manual) {
    if (manual) break;
    manual = capture.set(control.automatic, value) && capture.get(control.automatic) == value;
  }
  capture.set(control.value, state.value);
  const double kept = capture.get(control.value);
  state.locked = manual && kept == state.value;
  if (!state.locked) state.remark = "The camera keeps changing it by itself.";
  state.value = kept;
  return state;
}

class OpenCvSource final : public FrameSource {
 public:
  OpenCvSource(const cv::VideoCapture& capture, std::string name, bool stream)
      : capture_(capture), stream_(stream) {
    info_.description = std::move(name);
    readMode();
  }

  Result<void> grab(double timeout_s) override;
  Result<Frame> retrieve() override;
  CameraInfo lockControls() override;
  CameraInfo info() const override { return info_; }
  bool tellsEmptyQueue() const override { return !stream_; }

 private:
  void readMode();
  Error gone() const;

  cv::VideoCapture capture_;
  bool stream_;
  CameraInfo info_;
  double grabbed_s_ = 0.0;
};

void OpenCvSource::readMode() {
  info_.width_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH));
  info_.height_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
  const double rate = capture_.get(cv::CAP_PROP_FPS);
  info_.frames_per_s = std::isfinite(rate) && rate > 0.0 ? rate : 0.0;
}

Error OpenCvSource::gone() const {
  return {Error::Code::kGone, "The camera " + info_.description + " gives no pictures any more.",
          "Check its cable or network and start again; what was captured is kept."};
}

Result<void> OpenCvSource::grab(double timeout_s) try {
  if (!stream_) {
    // grab() of a driver waits ten seconds; asked beforehand, it returns at once.
    std::vector<int> ready;
    const auto timeout_ns = static_cast<std::int64_t>(timeout_s * 1e9);
    if (!cv::VideoCapture::waitAny({capture_}, ready, timeout_ns)) {
      return Error{Error::Code::kTimeout, "The camera gave no picture yet.", ""};
    }
    if (ready.empty()) return gone();
  }
  if (!capture_.grab()) return gone();
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

CameraInfo OpenCvSource::lockControls() try {
  info_.controls.clear();
  for (const Control& control : controls()) {
    if (stream_) {
      info_.controls.push_back({control.name, false, 0.0,
                                "A stream has no controls; set it in the camera's own program."});
    } else {
      info_.controls.push_back(lockControl(capture_, control));
    }
  }
  return info_;
} catch (const cv::Exception&) {
  return info_;
}

Result<void> setMode(cv::VideoCapture& capture, const OpenCvSourceOptions& options) {
  const auto keeps = [&](int property, double value) {
    return value <= 0.0 || (capture.set(property, value) && capture.get(property) == value);
  };
  // The format first: it decides which sizes and rates there are.
  const double format = options.pixel_format.empty() ? 0.0 : fourccFromText(options.pixel_format);
  const bool kept = keeps(cv::CAP_PROP_FOURCC, format) &&
                    keeps(cv::CAP_PROP_FRAME_WIDTH, options.width_px) &&
                    keeps(cv::CAP_PROP_FRAME_HEIGHT, options.height_px) &&
                    keeps(cv::CAP_PROP_FPS, options.frames_per_s) &&
                    keeps(cv::CAP_PROP_FRAME_WIDTH, options.width_px);
  if (kept) return {};
  return Error{Error::Code::kRejected, "The camera does not offer the mode that was asked for.",
               "Leave the mode out, or choose one that `v4l2-ctl --list-formats-ext` lists."};
}

Result<std::unique_ptr<FrameSource>> openStream(const std::string& url,
                                                const OpenCvSourceOptions& options) {
  const std::vector<int> parameters = {
      cv::CAP_PROP_OPEN_TIMEOUT_MSEC, static_cast<int>(options.open_timeout_s * 1e3),
      cv::CAP_PROP_READ_TIMEOUT_MSEC, static_cast<int>(options.read_timeout_s * 1e3)};
  cv::VideoCapture capture;
  const double start_s = steadySeconds();
  if (!capture.open(url, cv::CAP_FFMPEG, parameters)) {
    const bool late = steadySeconds() - start_s >= 0.9 * options.open_timeout_s;
    return Error{late ? Error::Code::kTimeout : Error::Code::kNotFound,
                 "The camera at " + withoutPassword(url) +
                     (late ? " did not answer in time." : " could not be opened."),
                 "Open the same address in a browser to see whether it sends pictures."};
  }
  return std::unique_ptr<FrameSource>(
      std::make_unique<OpenCvSource>(std::move(capture), withoutPassword(url), true));
}

Result<std::unique_ptr<FrameSource>> openDevice(const std::string& path,
                                                const OpenCvSourceOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::is_character_file(path, ignored)) return notACamera(path);
  if (access(path.c_str(), R_OK | W_OK) != 0) {
    return Error{Error::Code::kNoPermission, "You may not use the camera " + path + ".",
                 "Run `sudo usermod -aG video $USER`, then log out and in again."};
  }
  cv::VideoCapture capture;
  if (!capture.open(path, cv::CAP_V4L2)) {
    return Error{Error::Code::kBusy, "The camera " + path + " could not be opened.",
                 "Close other programs that use it, or choose another /dev/video: some cameras "
                 "have several, and only one gives pictures."};
  }
  capture.set(cv::CAP_PROP_CONVERT_RGB, 1.0);
  if (const auto set = setMode(capture, options); !set) return set.error();
  return std::unique_ptr<FrameSource>(
      std::make_unique<OpenCvSource>(std::move(capture), path, false));
}

}  // namespace

Result<OpenCvSourceOptions> cameraModeFromText(const std::string& mode) {
  static const std::regex kMode(R"((\d{1,5})x(\d{1,5})(?:@([A-Za-z0-9]{4}))?(?:@(\d{1,3}))?)");
  std::smatch part;
  if (!std::regex_match(mode, part, kMode)) {
    return Error{Error::Code::kInvalidInput, "\"" + mode + "\" is not a camera mode.",
                 "Write it as 1920x1080, 1920x1080@MJPG or 1920x1080@MJPG@30."};
  }
  OpenCvSourceOptions options;
  options.width_px = std::stoi(part[1]);
  options.height_px = std::stoi(part[2]);
  options.pixel_format = part[3];
  if (part[4].matched) options.frames_per_s = std::stod(part[4]);
  return options;
}

Result<std::unique_ptr<FrameSource>> openOpenCvSource(const std::string& camera,
                                                      const OpenCvSourceOptions& options) try {
  if (isUrl(camera)) return openStream(camera, options);
  const bool index = !camera.empty() && camera.size() <= 3 &&
                     camera.find_first_not_of("0123456789") == std::string::npos;
  return openDevice(index ? "/dev/video" + camera : camera, options);
} catch (const cv::Exception& problem) {
  return Error{Error::Code::kInternal,
               "The camera " + withoutPassword(camera) + " could not be opened: " + problem.err,
               "Try another camera or mode."};
}

}  // namespace gyre
