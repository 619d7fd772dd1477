// A camera on the loopback network: serves JPEG pictures over HTTP as cheap network cameras do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include <opencv2/core/mat.hpp>

namespace gyre::test {

// One client at a time, on 127.0.0.1, at a port the system chooses.
class MjpegServer {
 public:
  // picture(n) gives the n-th picture since the start, called in the server's thread.
  MjpegServer(std::function<cv::Mat(int)> picture, double frames_per_s);
  ~MjpegServer();
  MjpegServer(const MjpegServer&) = delete;
  MjpegServer& operator=(const MjpegServer&) = delete;

  int port() const { return port_; }
  std::string url() const;

  // The client stays connected and gets nothing more.
  void freeze() { frozen_ = true; }
  // The client is cut off, and nobody else is let in.
  void vanish() { gone_ = true; }

 private:
  void serve(const std::stop_token& stop);
  void stream(int client, const std::stop_token& stop);

  std::function<cv::Mat(int)> picture_;
  double interval_s_;
  int listener_ = -1;
  int port_ = 0;
  int next_picture_ = 0;
  std::atomic<bool> frozen_{false};
  std::atomic<bool> gone_{false};
  std::jthread thread_;
};

}  // namespace gyre::test
