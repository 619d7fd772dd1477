// A still camera on the loopback network, which speaks PTP over IP (CIPA DC-005, ISO 15740).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gyre::test {

using Bytes = std::vector<unsigned char>;

// Serves one client at a time at a port that the system chooses. A shutter release makes one
// picture, which can be fetched and deleted.
class PtpIpCamera {
 public:
  // picture(n) gives the bytes of the file of the n-th shot, called in the camera's thread.
  explicit PtpIpCamera(std::function<Bytes(int)> picture);
  ~PtpIpCamera();
  PtpIpCamera(const PtpIpCamera&) = delete;
  PtpIpCamera& operator=(const PtpIpCamera&) = delete;

  // "ptpip:127.0.0.1:PORT"
  std::string word() const;

  // What hands do to it. Any thread.
  void refuseShots(bool refuse) { refusing_ = refuse; }
  void vanish() { gone_ = true; }  // cuts the connection; nobody is let in until comeBack()
  void comeBack() { gone_ = false; }
  void freeze(bool frozen) { frozen_ = frozen; }  // keeps the connection and answers nothing
  void setProperty(std::uint16_t code, std::uint16_t value);
  std::uint16_t property(std::uint16_t code) const;

  int shots() const { return shots_; }
  int filesLeft() const;

  static constexpr std::uint16_t kWhiteBalance = 0x5005;
  static constexpr std::uint16_t kFNumber = 0x5007;
  static constexpr std::uint16_t kFocusMode = 0x500A;
  static constexpr std::uint16_t kProgram = 0x500E;

 private:
  struct Answer {
    std::uint16_t code = 0x2001;  // OK
    std::vector<std::uint32_t> parameters;
    Bytes data;
    bool has_data = false;
  };

  void serve(const std::stop_token& stop);
  void session(int command, int event, const std::stop_token& stop);
  int admit(const std::stop_token& stop, std::uint32_t expected_type);
  bool receive(int socket, Bytes& packet, const std::stop_token& stop);
  Answer answerTo(std::uint16_t operation, const std::vector<std::uint32_t>& parameters,
                  const Bytes& sent);
  Answer aboutObject(std::uint16_t operation, std::uint32_t handle,
                     const std::vector<std::uint32_t>& parameters);
  Answer aboutProperty(std::uint16_t operation, std::uint16_t code, const Bytes& sent);

  std::function<Bytes(int)> picture_;
  int listener_ = -1;
  int port_ = 0;
  std::atomic<bool> refusing_{false};
  std::atomic<bool> gone_{false};
  std::atomic<bool> frozen_{false};
  std::atomic<int> shots_{0};
  mutable std::mutex mutex_;
  std::map<std::uint16_t, std::uint16_t> properties_;
  std::map<std::uint32_t, Bytes> files_;
  std::jthread thread_;  // last
};

}  // namespace gyre::test
