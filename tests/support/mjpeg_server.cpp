// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/mjpeg_server.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "tests/support/loopback.h"

namespace gyre::test {
namespace {

bool sendAll(int client, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string partOf(const std::vector<unsigned char>& jpeg) {
  return "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) +
         "\r\n\r\n" + std::string(jpeg.begin(), jpeg.end()) + "\r\n";
}

}  // namespace

std::vector<unsigned char> jpegOf(const cv::Mat& picture) {
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 98});
  return jpeg;
}

MjpegServer::MjpegServer(std::function<cv::Mat(int)> picture, double frames_per_s)
    : picture_(std::move(picture)), interval_s_(1.0 / frames_per_s) {
  std::tie(listener_, port_) = listenOnLoopback();
  thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

MjpegServer::~MjpegServer() {
  thread_.request_stop();
  thread_.join();
  if (listener_ >= 0) close(listener_);
}

std::string MjpegServer::url() const {
  return "http://127.0.0.1:" + std::to_string(port_) + "/video.mjpg";
}

void MjpegServer::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (gone_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    pollfd waiting{listener_, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0) continue;
    const int client = accept(listener_, nullptr, nullptr);
    if (client < 0) continue;
    ++clients_;
    char request[4096];
    if (recv(client, request, sizeof(request), 0) > 0) stream(client, stop);
    close(client);
  }
}

bool MjpegServer::sendPicture(int client) {
  std::vector<unsigned char> jpeg = jpegOf(picture_(next_picture_++));
  if (torn_ > 0) {
    --torn_;
    jpeg.resize(jpeg.size() / 2);
  }
  const std::string part = partOf(jpeg);
  if (!dropping_.exchange(false)) return sendAll(client, part);
  sendAll(client, std::string_view(part).substr(0, part.size() / 2));
  return false;
}

void MjpegServer::stream(int client, const std::stop_token& stop) {
  if (!sendAll(client,
               "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; "
               "boundary=frame\r\n\r\n")) {
    return;
  }
  auto due = std::chrono::steady_clock::now();
  while (!stop.stop_requested() && !gone_) {
    if (!frozen_ && !sendPicture(client)) return;
    due += std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>(interval_s_));
    std::this_thread::sleep_until(due);
  }
}

}  // namespace gyre::test
