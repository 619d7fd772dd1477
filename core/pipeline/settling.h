// Takes pictures of a table that has stopped, once nothing in them moves any more.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/camera.h"

namespace gyre {

// Whether something moved between two pictures of equal size: more pixels differ than noise
// explains, once a common change of brightness is taken out.
bool somethingMoved(const cv::Mat& before_bgr, const cv::Mat& after_bgr);

// A motor that stands does not mean an object that stands: tables swing out. How long that takes is
// measured by comparing pictures in the first views and in some later ones; in between, the longest
// time seen so far is waited, which costs nothing on a stiff table. One thread.
class Settling {
 public:
  // known_s: how long the table was seen to swing before; no picture is taken sooner. What is
  // longer than tables swing is cut short. [s]
  explicit Settling(double known_s = 0.0);

  // The first picture after stood_s in which nothing moves. When the pictures never come to rest (a
  // flickering lamp, a curtain), a fixed delay is waited from then on.
  Result<FramePtr> grabStill(Camera& camera, double stood_s, const Task& task);

  double delaySeconds() const { return delay_s_; }

 private:
  Result<FramePtr> watch(Camera& camera, double stood_s, const Task& task);

  const double known_s_;
  int views_ = 0;
  double delay_s_ = 0.0;
  bool watching_helps_ = true;
};

}  // namespace gyre
