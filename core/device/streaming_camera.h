// Reads a frame source all the time, so that a picture is never older than asked for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "core/device/camera.h"
#include "core/device/frame_source.h"

namespace gyre {

struct StreamingCameraOptions {
  // Without any picture for so long, the camera is reported as silent. [s], > 0
  double silence_s = 5.0;
  // With pictures, but none provably taken after the moment asked for. [s], > silence_s
  double patience_s = 15.0;
  // The time a picture may be on its way from the sensor to the driver. Raise it for cameras on a
  // network, which code and send before anything arrives. [s], >= 0
  double transport_delay_s = 0.0;
};

// Drivers queue pictures that nobody fetched (four in V4L2; 32 were measured over HTTP), so the
// arrival of a picture says little about its exposure. A thread therefore takes pictures as they
// come, and notes the moments at which the queue was empty: what comes after such a moment arrived
// after it, and the exposure of the picture after that began after it too. Pictures are decoded
// only while somebody waits for one, and one picture serves all who wait. Any thread.
class StreamingCamera final : public Camera {
 public:
  explicit StreamingCamera(std::unique_ptr<FrameSource> source,
                           const StreamingCameraOptions& options = {});
  ~StreamingCamera()
      override;  // ends the thread after the grab in flight; nobody may wait any more
  StreamingCamera(const StreamingCamera&) = delete;
  StreamingCamera& operator=(const StreamingCamera&) = delete;

  Result<FramePtr> grabAfter(double time_s, const Task& task) override;
  Result<CameraInfo> lockControls() override { return askSource(Wish::kLock); }
  Result<CameraInfo> readControls() override { return askSource(Wish::kRead); }
  CameraInfo info() const override;

  // Spent on decoding so far; on rendering, where the camera is simulated.
  double decodingSeconds() const;

 private:
  // A decoded picture and a moment before which its exposure did not begin.
  struct Picture {
    FramePtr frame;
    double exposed_after_s = 0.0;
  };

  enum class Wish : std::uint8_t { kLock, kRead };

  Result<CameraInfo> askSource(Wish wish);
  void run(const std::stop_token& stop);
  void noteTrouble(const Result<void>& grabbed);
  Result<void> grabNext();
  void noteArrival(double call_s, double arrival_s);
  void serveControls();
  bool wanted() const;
  bool publish();  // false when the camera has failed for good
  void fail(const Error& error);
  std::optional<Error> overdue(double asked_s) const;

  // Of the thread alone.
  std::unique_ptr<FrameSource> source_;
  const StreamingCameraOptions options_;
  double empty_s_ = -1e300;          // the queue was empty then; the latest such moment
  double exposed_after_s_ = -1e300;  // bound for the picture grabbed last
  double interval_s_ = 0.0;          // running mean between pictures; 0 before two of them
  int gaps_ = 0;
  int broken_pictures_ = 0;  // in a row

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  CameraInfo info_;
  Picture latest_;
  double decoding_s_ = 0.0;
  std::optional<Error> failure_;  // the thread has ended
  double last_arrival_s_;
  std::multiset<double> waits_s_;  // the moments that somebody waits for
  int asked_ = 0;                  // of the controls, so far
  int answered_ = 0;
  bool lock_asked_ = false;
  std::optional<Error> trouble_;  // what the source says of its silence

  std::jthread thread_;  // last: it must stop before the rest goes
};

}  // namespace gyre
