// A camera of the simulated rig: pictures come by the clock, and wait in a queue as in a driver.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/device/frame_source.h"
#include "core/sim/renderer.h"
#include "core/sim/shaft.h"
#include "core/sim/sim_clock.h"

namespace gyre {

// Exposes frames_per_s pictures a simulated second and keeps the four oldest that nobody took: who
// comes late gets stale pictures, as from a real driver. Only what is retrieved is rendered.
class SimCamera final : public FrameSource {
 public:
  static constexpr std::size_t kQueueLength = 4;

  // The shaft is read at each exposure. Starts with an empty table.
  SimCamera(std::shared_ptr<const Renderer> renderer, std::shared_ptr<const Shaft> shaft,
            SimClock clock);
  ~SimCamera() override = default;

  Result<void> grab(double timeout_s) override;
  Result<Frame> retrieve() override;
  CameraInfo lockControls() override;
  CameraInfo info() const override;

  // The hand that puts the object on the table and takes it away. Any thread.
  void setTable(TableLoad load) { load_.store(load); }
  TableLoad table() const { return load_.load(); }
  // The same hand lays the object differently: pictures from now on are of this room, which has the
  // same camera. Any thread.
  void setRoom(std::shared_ptr<const Renderer> renderer);

 private:
  // What a picture shows, fixed when it was exposed.
  struct Exposure {
    std::shared_ptr<const Renderer> room;
    std::int64_t steps = 0;
    TableLoad load = TableLoad::kEmpty;
    bool operator==(const Exposure&) const = default;
  };

  void exposeByTheClock(const std::stop_token& stop);

  const RigSettings rig_;
  std::shared_ptr<const Shaft> shaft_;
  SimClock clock_;
  std::atomic<TableLoad> load_{TableLoad::kEmpty};

  std::mutex mutex_;  // guards renderer_ and queue_
  std::shared_ptr<const Renderer> renderer_;
  std::condition_variable_any arrived_;
  std::deque<Exposure> queue_;

  // Of the one thread that grabs.
  std::optional<Exposure> grabbed_;
  double grabbed_at_s_ = 0.0;
  std::optional<Exposure> rendered_;
  cv::Mat rendered_bgr_;

  std::jthread ticker_;  // last: it uses the others
};

}  // namespace gyre
