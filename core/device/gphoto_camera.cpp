// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/gphoto_camera.h"

#include <chrono>
#include <condition_variable>
#include <cmath>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/device/gphoto_link.h"

namespace gyre {
namespace {

constexpr std::chrono::milliseconds kSlice{50};

class GphotoCamera final : public Camera {
 public:
  GphotoCamera(std::unique_ptr<GphotoLink> link, const GphotoOptions& options)
      : options_(options), link_(std::move(link)) {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~GphotoCamera() override { link_->giveUp(); }
  GphotoCamera(const GphotoCamera&) = delete;
  GphotoCamera& operator=(const GphotoCamera&) = delete;

  Result<void> open();
  Result<FramePtr> grabAfter(double time_s, const Task& task) override;
  Result<CameraInfo> lockControls() override { return told(GphotoLink::Controls::kLock); }
  Result<CameraInfo> readControls() override { return told(GphotoLink::Controls::kRead); }
  CameraInfo info() const override {
    const std::scoped_lock lock(mutex_);
    return info_;
  }
  Result<FramePtr> preview(const Task& task) override;

 private:
  struct Shot {
    Result<cv::Mat> picture;
    double began_s;
  };

  // Runs the call in the camera's thread and waits for what it gives.
  template <class Value>
  Result<Value> inThread(std::function<Result<Value>()> call, double timeout_s, const Task& task);
  Result<CameraInfo> told(GphotoLink::Controls what);
  void run(const std::stop_token& stop);

  const GphotoOptions options_;
  std::unique_ptr<GphotoLink> link_;  // of the thread
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::function<void()>> calls_;
  CameraInfo info_;
  FramePtr present_;
  std::jthread thread_;  // last: it must stop before the rest goes
};

Error late(double seconds) {
  return {Error::Code::kTimeout,
          "The camera did not answer for " + std::to_string(std::lround(seconds)) + " seconds.",
          "Look at its display: is it on, awake and not in a menu? Then try again."};
}

void GphotoCamera::run(const std::stop_token& stop) {
  while (true) {
    std::function<void()> call;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return !calls_.empty(); })) return;
      call = std::move(calls_.front());
      calls_.pop_front();
    }
    call();
  }
}

template <class Value>
Result<Value> GphotoCamera::inThread(std::function<Result<Value>()> call, double timeout_s,
                                     const Task& task) {
  // The thread may come to it when nobody waits any more: whoever holds it last frees it.
  auto work = std::make_shared<std::packaged_task<Result<Value>()>>(std::move(call));
  auto answer = work->get_future();
  {
    const std::scoped_lock lock(mutex_);
    calls_.emplace_back([work] { (*work)(); });
  }
  changed_.notify_all();
  const double deadline_s = steadySeconds() + timeout_s;
  while (answer.wait_for(kSlice) != std::future_status::ready) {
    if (task.stopRequested()) return cancelled();
    if (steadySeconds() > deadline_s) return late(timeout_s);
  }
  return answer.get();
}

Result<void> GphotoCamera::open() {
  auto info = inThread<CameraInfo>([this] { return link_->open(); }, options_.open_timeout_s, {});
  if (!info) return info.error();
  const std::scoped_lock lock(mutex_);
  info_ = std::move(info).value();
  return {};
}

Result<FramePtr> GphotoCamera::grabAfter(double time_s, const Task& task) {
  {
    const std::scoped_lock lock(mutex_);
    if (present_ && time_s < present_->time_s) return present_;
  }
  const double wait_s = time_s - steadySeconds();
  if (wait_s > 0.0 && !task.sleepFor(wait_s)) return cancelled();
  auto shot = inThread<Shot>(
      [this]() -> Result<Shot> {
        const double began_s = steadySeconds();
        return Shot{link_->shoot(), began_s};
      },
      options_.shot_timeout_s, task);
  if (!shot) return shot.error();
  if (!shot->picture) return shot->picture.error();
  Frame frame;
  frame.time_s = shot->began_s;
  frame.image_bgr = shot->picture.value();
  const std::scoped_lock lock(mutex_);
  info_.width_px = frame.image_bgr.cols;
  info_.height_px = frame.image_bgr.rows;
  present_ = std::make_shared<const Frame>(std::move(frame));
  return present_;
}

Result<FramePtr> GphotoCamera::preview(const Task& task) {
  auto picture =
      inThread<cv::Mat>([this] { return link_->preview(); }, options_.shot_timeout_s, task);
  if (!picture) return picture.error();
  Frame frame;
  frame.time_s = steadySeconds();
  frame.image_bgr = std::move(picture).value();
  return std::make_shared<const Frame>(std::move(frame));
}

Result<CameraInfo> GphotoCamera::told(GphotoLink::Controls what) {
  auto controls = inThread<std::vector<ControlState>>(
      [this, what] { return link_->controls(what); }, options_.open_timeout_s, {});
  if (!controls) return controls.error();
  const std::scoped_lock lock(mutex_);
  info_.controls = std::move(controls).value();
  return info_;
}

}  // namespace

bool namesGphoto(const std::string& camera) {
  return camera.starts_with("gphoto:") || camera.starts_with("ptpip:");
}

Result<std::unique_ptr<Camera>> openGphotoCamera(const std::string& camera,
                                                 const GphotoOptions& options) {
  auto link = GphotoLink::forWord(camera);
  if (!link) return link.error();
  auto opened = std::make_unique<GphotoCamera>(std::move(link).value(), options);
  if (const auto answered = opened->open(); !answered) return answered.error();
  return std::unique_ptr<Camera>(std::move(opened));
}

}  // namespace gyre
