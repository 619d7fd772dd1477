// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/gphoto_camera.h"

#include <pthread.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
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
// How long the camera's end waits for the call in flight, before it is left to itself.
constexpr std::chrono::seconds kFarewell{3};

// libgphoto2 writes to connections that are gone; the signal of it would end the program.
void blockBrokenPipes() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

Error late(double seconds) {
  return {
      Error::Code::kTimeout,
      "The camera did not answer for " + std::to_string(std::lround(seconds)) + " seconds.",
      "Look at its display: is it on, awake and not in a menu, does it find its focus, has it a "
      "card with space? Then try again."};
}

// A thread of its own for a camera. Some calls of libgphoto2 never come back: such a thread is left
// to itself with all that it uses, and ends should the call end after all.
class Worker {
 public:
  explicit Worker(std::unique_ptr<GphotoLink> link) : link_(std::move(link)) {}

  static std::shared_ptr<Worker> start(std::unique_ptr<GphotoLink> link) {
    auto worker = std::make_shared<Worker>(std::move(link));
    std::thread([worker] { worker->run(); }).detach();
    return worker;
  }

  void add(std::function<void(GphotoLink&)> call) {
    const std::scoped_lock lock(mutex_);
    calls_.push_back(std::move(call));
    changed_.notify_all();
  }

  // What waits is dropped; the call in flight is asked to give up.
  void end() {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    calls_.clear();
    if (link_) link_->giveUp();
    changed_.notify_all();
  }

  void awaitEnd() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kFarewell, [this] { return link_ == nullptr; });
  }

 private:
  void run() {
    blockBrokenPipes();
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return ending_ || !calls_.empty(); });
      if (ending_) break;
      const auto call = std::exchange(calls_.front(), nullptr);
      calls_.pop_front();
      lock.unlock();
      call(*link_);
      lock.lock();
    }
    lock.unlock();
    link_->close();  // in its own thread
    lock.lock();
    link_ = nullptr;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void(GphotoLink&)>> calls_;
  std::unique_ptr<GphotoLink> link_;  // null when the thread has ended
  bool ending_ = false;
};

class GphotoCamera final : public Camera {
 public:
  GphotoCamera(std::string word, const GphotoOptions& options)
      : word_(std::move(word)), options_(options) {}
  ~GphotoCamera() override {
    if (!worker_) return;
    worker_->end();
    worker_->awaitEnd();
  }
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
    cv::Mat image_bgr;
    double began_s;
  };

  // Runs the call in the camera's thread and waits for what it gives.
  template <class Value>
  Result<Value> inThread(std::function<Result<Value>(GphotoLink&)> call, double timeout_s,
                         const Task& task);
  Result<std::shared_ptr<Worker>> worker();
  void abandon(const std::shared_ptr<Worker>& worker);
  Result<CameraInfo> told(GphotoLink::Controls what);

  const std::string word_;
  const GphotoOptions options_;
  mutable std::mutex mutex_;
  std::shared_ptr<Worker> worker_;
  CameraInfo info_;
  FramePtr present_;
};

Result<std::shared_ptr<Worker>> GphotoCamera::worker() {
  const std::scoped_lock lock(mutex_);
  if (worker_) return worker_;
  auto link = GphotoLink::forWord(word_);
  if (!link) return link.error();
  worker_ = Worker::start(std::move(link).value());
  return worker_;
}

void GphotoCamera::abandon(const std::shared_ptr<Worker>& worker) {
  worker->end();
  const std::scoped_lock lock(mutex_);
  if (worker_ == worker) worker_ = nullptr;
}

template <class Value>
Result<Value> GphotoCamera::inThread(std::function<Result<Value>(GphotoLink&)> call,
                                     double timeout_s, const Task& task) {
  const auto at_work = worker();
  if (!at_work) return at_work.error();
  // The thread may come to it when nobody waits any more: whoever holds it last frees it.
  auto work = std::make_shared<std::packaged_task<Result<Value>(GphotoLink&)>>(std::move(call));
  auto answer = work->get_future();
  (*at_work)->add([work](GphotoLink& link) { (*work)(link); });
  const double deadline_s = steadySeconds() + timeout_s;
  while (answer.wait_for(kSlice) != std::future_status::ready) {
    if (task.stopRequested()) return cancelled();
    if (steadySeconds() > deadline_s) {
      abandon(*at_work);
      return late(timeout_s);
    }
  }
  return answer.get();
}

Result<void> GphotoCamera::open() {
  auto info = inThread<CameraInfo>([](GphotoLink& link) { return link.open(); },
                                   options_.open_timeout_s, {});
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
      [](GphotoLink& link) -> Result<Shot> {
        const double began_s = steadySeconds();
        auto image_bgr = link.shoot();
        if (!image_bgr) return image_bgr.error();
        return Shot{std::move(image_bgr).value(), began_s};
      },
      options_.shot_timeout_s, task);
  if (!shot) return shot.error();
  Frame frame;
  frame.time_s = shot->began_s;
  frame.image_bgr = shot->image_bgr;
  const std::scoped_lock lock(mutex_);
  info_.width_px = frame.image_bgr.cols;
  info_.height_px = frame.image_bgr.rows;
  present_ = std::make_shared<const Frame>(std::move(frame));
  return present_;
}

Result<FramePtr> GphotoCamera::preview(const Task& task) {
  auto picture = inThread<cv::Mat>([](GphotoLink& link) { return link.preview(); },
                                   options_.shot_timeout_s, task);
  if (!picture) return picture.error();
  Frame frame;
  frame.time_s = steadySeconds();
  frame.image_bgr = std::move(picture).value();
  return std::make_shared<const Frame>(std::move(frame));
}

Result<CameraInfo> GphotoCamera::told(GphotoLink::Controls what) {
  auto controls = inThread<std::vector<ControlState>>(
      [what](GphotoLink& link) { return link.controls(what); }, options_.open_timeout_s, {});
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
  auto opened = std::make_unique<GphotoCamera>(camera, options);
  if (const auto answered = opened->open(); !answered) return answered.error();
  return std::unique_ptr<Camera>(std::move(opened));
}

}  // namespace gyre
