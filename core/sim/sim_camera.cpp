// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/sim_camera.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/check.h"
#include "core/base/clock.h"

namespace gyre {

SimCamera::SimCamera(std::shared_ptr<const Renderer> renderer, std::shared_ptr<const Shaft> shaft,
                     SimClock clock)
    : rig_(renderer->rig()),
      shaft_(std::move(shaft)),
      clock_(clock),
      renderer_(std::move(renderer)) {
  GYRE_CHECK(shaft_ != nullptr);
  ticker_ = std::jthread([this](const std::stop_token& stop) { exposeByTheClock(stop); });
}

void SimCamera::setRoom(std::shared_ptr<const Renderer> renderer) {
  GYRE_CHECK(renderer != nullptr);
  const std::lock_guard lock(mutex_);
  renderer_ = std::move(renderer);
}

void SimCamera::exposeByTheClock(const std::stop_token& stop) {
  const double period_s = 1.0 / rig_.frames_per_s;
  std::mutex sleep_mutex;
  std::condition_variable_any sleeper;
  double next_s = (std::floor(clock_.seconds() / period_s) + 1.0) * period_s;
  while (!stop.stop_requested()) {
    const double wait_s = clock_.realSecondsFor(next_s - clock_.seconds());
    if (wait_s > 0.0) {
      std::unique_lock lock(sleep_mutex);
      sleeper.wait_for(lock, stop, std::chrono::duration<double>(wait_s), [] { return false; });
      continue;
    }
    {
      const std::lock_guard lock(mutex_);
      // A full queue loses the new picture, not the old ones: a driver has no free buffer for it.
      if (queue_.size() < kQueueLength) {
        queue_.push_back({renderer_, shaft_->tableSteps(), load_.load()});
      }
    }
    arrived_.notify_one();
    // Exposures that this thread slept through are lost, not made up for.
    next_s = std::max(next_s + period_s, clock_.seconds());
  }
}

Result<void> SimCamera::grab(double timeout_s) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                         [this] { return !queue_.empty(); })) {
    return Error{Error::Code::kTimeout, "The simulated camera gave no picture in time.", ""};
  }
  grabbed_ = queue_.front();
  queue_.pop_front();
  grabbed_at_s_ = steadySeconds();
  return {};
}

Result<Frame> SimCamera::retrieve() {
  if (!grabbed_) {
    return Error{Error::Code::kInternal, "No picture was grabbed from the simulated camera.", ""};
  }
  // The same world gives the same picture: while the table rests one rendering serves.
  if (rendered_ != grabbed_) {
    rendered_bgr_ = grabbed_->room->render(grabbed_->steps, grabbed_->load).image_bgr;
    rendered_ = grabbed_;
  }
  Frame frame;
  frame.time_s = grabbed_at_s_;
  frame.image_bgr = rendered_bgr_.clone();
  return frame;
}

CameraInfo SimCamera::lockControls() { return info(); }

CameraInfo SimCamera::info() const {
  CameraInfo info;
  info.description = "Simulated camera";
  info.width_px = rig_.image_width_px;
  info.height_px = rig_.image_height_px;
  info.frames_per_s = rig_.frames_per_s;
  for (const char* name : {"focus", "exposure", "gain", "white balance"}) {
    info.controls.push_back({name, /*locked=*/true, /*value=*/0.0, /*remark=*/""});
  }
  return info;
}

}  // namespace gyre
