// A camera on the loopback network: serves JPEG pictures over HTTP as cheap network cameras do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace gyre::test {

// The picture as the server sends it.
std::vector<unsigned char> jpegOf(const cv::Mat& picture);

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

  // The client stays connected and gets nothing until thaw().
  void freeze() { frozen_ = true; }
  void thaw() { frozen_ = false; }
  // The client is cut off, and nobody else is let in until comeBack().
  void vanish() { gone_ = true; }
  void comeBack() { gone_ = false; }
  // The connection ends in the middle of the next picture; the client may come again.
  void drop() { dropping_ = true; }
  // The next so many pictures are sent in half, as a camera does that is short of memory.
  void tear(int pictures) { torn_ = pictures; }
  // How many clients have been served so far.
  int clients() const { return clients_; }

 private:
  void serve(const std::stop_token& stop);
  void stream(int client, const std::stop_token& stop);
  bool sendPicture(int client);

  std::function<cv::Mat(int)> picture_;
  double interval_s_;
  int listener_ = -1;
  int port_ = 0;
  int next_picture_ = 0;
  std::atomic<bool> frozen_{false};
  std::atomic<bool> gone_{false};
  std::atomic<bool> dropping_{false};
  std::atomic<int> torn_{0};
  std::atomic<int> clients_{0};
  std::jthread thread_;
};

}  // namespace gyre::test
