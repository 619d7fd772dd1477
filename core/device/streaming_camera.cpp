// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/streaming_camera.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/check.h"
#include "core/base/clock.h"

namespace gyre {
namespace {

// How long one grab may wait: the longest that a lock request or the end of the thread waits.
constexpr double kGrabSlice_s = 0.1;
// A camera that sends this many undecodable pictures in a row will not send a good one.
constexpr int kMaxBrokenPictures = 30;
// The mean interval follows the last thirty pictures or so.
constexpr double kSmallestGain = 0.03;
// An outage is no interval between pictures.
constexpr double kLongestIntervals = 4.0;

Error silent(double seconds) {
  return {Error::Code::kTimeout,
          "The camera gave no picture for " + std::to_string(std::lround(seconds)) + " seconds.",
          "Check its cable or network, that no other program uses it, and try a lower resolution."};
}

Error alwaysLate() {
  return {Error::Code::kTimeout, "The camera sends pictures faster than they can be read.",
          "Choose a lower resolution or picture rate, so that no old pictures pile up."};
}

}  // namespace

StreamingCamera::StreamingCamera(std::unique_ptr<FrameSource> source,
                                 const StreamingCameraOptions& options)
    : source_(std::move(source)), options_(options), last_arrival_s_(steadySeconds()) {
  GYRE_CHECK(source_ != nullptr);
  GYRE_CHECK(options_.silence_s > 0.0 && options_.patience_s > options_.silence_s);
  info_ = source_->info();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

StreamingCamera::~StreamingCamera() = default;

Result<FramePtr> StreamingCamera::grabAfter(double time_s, const Task& task) {
  std::unique_lock lock(mutex_);
  const double asked_s = steadySeconds();
  const auto wait = waits_s_.insert(time_s);
  const auto answered = [&] {
    return failure_.has_value() || (latest_.frame && latest_.exposed_after_s > time_s);
  };
  std::optional<Error> problem;
  while (!problem && !answered()) {
    changed_.wait_for(lock, task.stopToken(), std::chrono::duration<double>(kGrabSlice_s),
                      answered);
    if (task.stopRequested()) problem = cancelled();
    if (!problem && !answered()) problem = overdue(asked_s);
  }
  waits_s_.erase(wait);
  if (problem) return *problem;
  if (failure_) return *failure_;
  return latest_.frame;
}

std::optional<Error> StreamingCamera::overdue(double asked_s) const {
  const double now_s = steadySeconds();
  if (now_s - std::max(asked_s, last_arrival_s_) > options_.silence_s) {
    return trouble_ ? *trouble_ : silent(options_.silence_s);
  }
  if (now_s - asked_s > options_.patience_s) return alwaysLate();
  return std::nullopt;
}

Result<CameraInfo> StreamingCamera::askSource(Wish wish) {
  std::unique_lock lock(mutex_);
  const int request = ++asked_;
  if (wish == Wish::kLock) lock_asked_ = true;
  // A driver may take its time over each control, but not for ever.
  const bool done = changed_.wait_for(lock, std::chrono::duration<double>(options_.patience_s),
                                      [&] { return failure_ || answered_ >= request; });
  if (failure_) return *failure_;
  if (!done) return silent(options_.patience_s);
  return info_;
}

CameraInfo StreamingCamera::info() const {
  const std::scoped_lock lock(mutex_);
  return info_;
}

double StreamingCamera::decodingSeconds() const {
  const std::scoped_lock lock(mutex_);
  return decoding_s_;
}

void StreamingCamera::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    serveControls();
    const Result<void> grabbed = grabNext();
    const bool came = grabbed.ok();
    noteTrouble(grabbed);
    if (!came && grabbed.error().code != Error::Code::kTimeout) return fail(grabbed.error());
    if (came && wanted() && !publish()) return;
  }
}

void StreamingCamera::noteTrouble(const Result<void>& grabbed) {
  const std::scoped_lock lock(mutex_);
  if (grabbed) {
    trouble_.reset();
  } else if (!grabbed.error().advice.empty()) {
    trouble_ = grabbed.error();
  }
}

Result<void> StreamingCamera::grabNext() {
  if (source_->tellsEmptyQueue()) {
    const double call_s = steadySeconds();
    const Result<void> queued = source_->grab(0.0);
    if (queued || queued.error().code != Error::Code::kTimeout) {
      if (queued) noteArrival(empty_s_, steadySeconds());
      return queued;
    }
    const Result<void> waited = source_->grab(kGrabSlice_s);
    if (waited) noteArrival(call_s, steadySeconds());
    return waited;
  }
  const double call_s = steadySeconds();
  const Result<void> grabbed = source_->grab(kGrabSlice_s);
  const double arrival_s = steadySeconds();
  // This source cannot say that its queue is empty. That it made us wait for a good part of the
  // interval between pictures says it: a queued one comes at once.
  const bool waited = arrival_s - call_s > 0.5 * interval_s_ && gaps_ > 1;
  if (grabbed) noteArrival(waited ? call_s : empty_s_, arrival_s);
  return grabbed;
}

// empty_s: the latest moment, at or before this grab, at which the queue was empty.
void StreamingCamera::noteArrival(double empty_s, double arrival_s) {
  // The picture before this one arrived after the moment noted then, and this one was exposed
  // after that one.
  exposed_after_s_ = empty_s_ - options_.transport_delay_s;
  empty_s_ = empty_s;
  const std::scoped_lock lock(mutex_);
  const double gain = std::max(1.0 / ++gaps_, kSmallestGain);
  double interval_s = arrival_s - last_arrival_s_;
  if (gaps_ > 2) interval_s = std::min(interval_s, kLongestIntervals * interval_s_);
  interval_s_ += gain * (interval_s - interval_s_);
  last_arrival_s_ = arrival_s;
}

void StreamingCamera::serveControls() {
  int request = 0;
  bool lock_asked = false;
  {
    const std::scoped_lock lock(mutex_);
    if (answered_ == asked_) return;
    request = asked_;
    lock_asked = std::exchange(lock_asked_, false);
  }
  CameraInfo told = lock_asked ? source_->lockControls() : source_->readControls();
  const std::scoped_lock lock(mutex_);
  info_ = std::move(told);
  answered_ = request;
  changed_.notify_all();
}

bool StreamingCamera::wanted() const {
  const std::scoped_lock lock(mutex_);
  return !waits_s_.empty() && *waits_s_.begin() < exposed_after_s_;
}

bool StreamingCamera::publish() {
  const double start_s = steadySeconds();
  Result<Frame> frame = source_->retrieve();
  const double taken_s = steadySeconds() - start_s;
  if (!frame) {
    if (++broken_pictures_ < kMaxBrokenPictures) return true;
    fail(frame.error());
    return false;
  }
  broken_pictures_ = 0;
  const std::scoped_lock lock(mutex_);
  decoding_s_ += taken_s;
  latest_ = {std::make_shared<const Frame>(std::move(frame).value()), exposed_after_s_};
  changed_.notify_all();
  return true;
}

void StreamingCamera::fail(const Error& error) {
  const std::scoped_lock lock(mutex_);
  failure_ = error;
  changed_.notify_all();
}

}  // namespace gyre
