// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ptpip_camera.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <tuple>
#include <utility>

#include "tests/support/loopback.h"

namespace gyre::test {
namespace {

// Types of packets.
enum Packet : std::uint32_t {
  kInitCommand = 1,
  kInitCommandAck = 2,
  kInitEvent = 3,
  kInitEventAck = 4,
  kRequest = 6,
  kResponse = 7,
  kEvent = 8,
  kStartData = 9,
  kData = 10,
  kEndData = 12,
};

enum Operation : std::uint16_t {
  kGetDeviceInfo = 0x1001,
  kOpenSession = 0x1002,
  kCloseSession = 0x1003,
  kGetStorageIds = 0x1004,
  kGetStorageInfo = 0x1005,
  kGetNumObjects = 0x1006,
  kGetObjectHandles = 0x1007,
  kGetObjectInfo = 0x1008,
  kGetObject = 0x1009,
  kDeleteObject = 0x100B,
  kInitiateCapture = 0x100E,
  kGetPropertyDesc = 0x1014,
  kGetPropertyValue = 0x1015,
  kSetPropertyValue = 0x1016,
};

constexpr std::uint16_t kOk = 0x2001;
constexpr std::uint16_t kNotSupported = 0x2005;
constexpr std::uint16_t kNoSuchHandle = 0x2009;
constexpr std::uint16_t kNoSuchProperty = 0x200A;
constexpr std::uint16_t kStoreFull = 0x200C;
constexpr std::uint16_t kObjectAdded = 0x4002;
constexpr std::uint16_t kCaptureComplete = 0x400D;
constexpr std::uint32_t kStore = 0x00010001;
constexpr std::uint16_t kJpegFormat = 0x3801;
constexpr std::uint16_t kUint16 = 0x0004;

void put(Bytes& bytes, std::uint64_t number, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(number >> (8 * i)));
}
void put16(Bytes& bytes, std::uint16_t number) { put(bytes, number, 2); }
void put32(Bytes& bytes, std::uint32_t number) { put(bytes, number, 4); }

void putText(Bytes& bytes, std::string_view text) {
  put(bytes, text.empty() ? 0 : text.size() + 1, 1);
  for (const char c : text) put16(bytes, static_cast<std::uint16_t>(c));
  if (!text.empty()) put16(bytes, 0);
}

void putList16(Bytes& bytes, const std::vector<std::uint16_t>& list) {
  put32(bytes, static_cast<std::uint32_t>(list.size()));
  for (const std::uint16_t entry : list) put16(bytes, entry);
}

std::uint64_t get(const Bytes& bytes, std::size_t at, int size) {
  std::uint64_t number = 0;
  for (int i = 0; i < size; ++i) {
    const std::size_t place = at + static_cast<std::size_t>(i);
    if (place < bytes.size()) number |= static_cast<std::uint64_t>(bytes[place]) << (8 * i);
  }
  return number;
}

Bytes packetOf(std::uint32_t type, const Bytes& content) {
  Bytes packet;
  put32(packet, static_cast<std::uint32_t>(content.size()) + 8);
  put32(packet, type);
  packet.insert(packet.end(), content.begin(), content.end());
  return packet;
}

bool sendAll(int socket, const Bytes& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t now = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (now <= 0) return false;
    sent += static_cast<std::size_t>(now);
  }
  return true;
}

Bytes deviceInfo() {
  Bytes info;
  put16(info, 100);
  put32(info, 0);
  put16(info, 100);
  putText(info, "");
  put16(info, 0);
  putList16(info, {kGetDeviceInfo, kOpenSession, kCloseSession, kGetStorageIds, kGetStorageInfo,
                   kGetNumObjects, kGetObjectHandles, kGetObjectInfo, kGetObject, kDeleteObject,
                   kInitiateCapture, kGetPropertyDesc, kGetPropertyValue, kSetPropertyValue});
  putList16(info, {kObjectAdded, kCaptureComplete});
  putList16(info, {PtpIpCamera::kWhiteBalance, PtpIpCamera::kFNumber, PtpIpCamera::kFocusMode,
                   PtpIpCamera::kProgram});
  putList16(info, {kJpegFormat});
  putList16(info, {kJpegFormat});
  putText(info, "Gyre");
  putText(info, "Loopback still camera");
  putText(info, "1.0");
  putText(info, "0001");
  return info;
}

Bytes storageInfo() {
  Bytes info;
  put16(info, 4);  // removable memory
  put16(info, 3);  // folders as on a camera's card
  put16(info, 0);
  put(info, 1U << 30U, 8);
  put(info, 1U << 29U, 8);
  put32(info, 1000);
  putText(info, "card");
  putText(info, "");
  return info;
}

Bytes objectInfo(std::uint32_t handle, std::size_t size) {
  Bytes info;
  put32(info, kStore);
  put16(info, kJpegFormat);
  put16(info, 0);
  put32(info, static_cast<std::uint32_t>(size));
  put16(info, 0);
  for (int i = 0; i < 7; ++i) put32(info, 0);  // thumbnail, size in pixels, depth, parent
  put16(info, 0);
  put32(info, 0);
  put32(info, handle);
  putText(info, "IMG_" + std::to_string(1000 + handle) + ".JPG");
  putText(info, "20200101T120000");
  putText(info, "20200101T120000");
  putText(info, "");
  return info;
}

// The values that a property may have: it must stand among them.
std::vector<std::uint16_t> choicesOf(std::uint16_t code) {
  if (code == PtpIpCamera::kWhiteBalance) return {1, 2, 4};  // manual, automatic, daylight
  if (code == PtpIpCamera::kFNumber) return {400, 800, 1100};
  if (code == PtpIpCamera::kFocusMode) return {1, 2};  // manual, automatic
  return {1, 2, 3};                                    // program: manual, automatic, aperture
}

}  // namespace

PtpIpCamera::PtpIpCamera(std::function<Bytes(int)> picture)
    : picture_(std::move(picture)),
      properties_{{kWhiteBalance, 4}, {kFNumber, 800}, {kFocusMode, 2}, {kProgram, 1}} {
  std::tie(listener_, port_) = listenOnLoopback();
  thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

PtpIpCamera::~PtpIpCamera() {
  thread_.request_stop();
  thread_.join();
  close(listener_);
}

std::string PtpIpCamera::word() const { return "ptpip:127.0.0.1:" + std::to_string(port_); }

void PtpIpCamera::setProperty(std::uint16_t code, std::uint16_t value) {
  const std::scoped_lock lock(mutex_);
  properties_[code] = value;
}

std::uint16_t PtpIpCamera::property(std::uint16_t code) const {
  const std::scoped_lock lock(mutex_);
  return properties_.at(code);
}

int PtpIpCamera::filesLeft() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<int>(files_.size());
}

// Reads one packet, its length and type included.
bool PtpIpCamera::receive(int socket, Bytes& packet, const std::stop_token& stop) {
  packet.clear();
  std::size_t wanted = 8;
  while (packet.size() < wanted) {
    if (stop.stop_requested() || gone_) return false;
    pollfd waiting{socket, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0 || frozen_) continue;
    unsigned char buffer[4096];
    const ssize_t got = recv(socket, buffer, std::min(sizeof(buffer), wanted - packet.size()), 0);
    if (got <= 0) return false;
    packet.insert(packet.end(), buffer, buffer + got);
    if (packet.size() >= 8) wanted = std::max<std::size_t>(8, get(packet, 0, 4));
  }
  return true;
}

// Lets a client in whose first packet is of the type; -1 when none comes.
int PtpIpCamera::admit(const std::stop_token& stop, std::uint32_t expected_type) {
  while (!stop.stop_requested() && !gone_) {
    pollfd waiting{listener_, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0) continue;
    const int client = accept(listener_, nullptr, nullptr);
    Bytes packet;
    if (receive(client, packet, stop) && get(packet, 4, 4) == expected_type) return client;
    close(client);
  }
  return -1;
}

void PtpIpCamera::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (gone_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    const int command = admit(stop, kInitCommand);
    if (command < 0) continue;
    Bytes ack;
    put32(ack, 1);
    for (int i = 0; i < 16; ++i) ack.push_back(7);  // its identity
    for (const char c : {'g', 'y', 'r', 'e', '\0'}) put16(ack, static_cast<std::uint16_t>(c));
    put32(ack, 0x10000);
    if (sendAll(command, packetOf(kInitCommandAck, ack))) {
      const int event = admit(stop, kInitEvent);
      if (event >= 0 && sendAll(event, packetOf(kInitEventAck, {}))) session(command, event, stop);
      if (event >= 0) close(event);
    }
    close(command);
  }
}

void PtpIpCamera::session(int command, int event, const std::stop_token& stop) {
  Bytes packet;
  while (receive(command, packet, stop)) {
    if (get(packet, 4, 4) != kRequest) continue;
    const bool sends = get(packet, 8, 4) == 2;
    const auto operation = static_cast<std::uint16_t>(get(packet, 12, 2));
    const auto transaction = static_cast<std::uint32_t>(get(packet, 14, 4));
    std::vector<std::uint32_t> parameters;
    for (std::size_t at = 18; at + 4 <= packet.size(); at += 4) {
      parameters.push_back(static_cast<std::uint32_t>(get(packet, at, 4)));
    }
    parameters.resize(5, 0);
    Bytes sent;
    for (bool more = sends; more;) {
      if (!receive(command, packet, stop)) return;
      const std::uint64_t type = get(packet, 4, 4);
      if (type != kStartData) sent.insert(sent.end(), packet.begin() + 12, packet.end());
      more = type != kEndData;
    }
    const Answer answer = answerTo(operation, parameters, sent);
    if (answer.has_data) {
      Bytes start;
      put32(start, transaction);
      put(start, answer.data.size(), 8);
      Bytes end;
      put32(end, transaction);
      end.insert(end.end(), answer.data.begin(), answer.data.end());
      if (!sendAll(command, packetOf(kStartData, start))) return;
      if (!sendAll(command, packetOf(kEndData, end))) return;
    }
    Bytes response;
    put16(response, answer.code);
    put32(response, transaction);
    for (const std::uint32_t parameter : answer.parameters) put32(response, parameter);
    if (!sendAll(command, packetOf(kResponse, response))) return;
    if (operation != kInitiateCapture || answer.code != kOk) continue;
    for (const std::uint16_t code : {kObjectAdded, kCaptureComplete}) {
      Bytes told;
      put16(told, code);
      put32(told, transaction);
      put32(told, code == kObjectAdded ? static_cast<std::uint32_t>(shots_.load()) : 0);
      if (!sendAll(event, packetOf(kEvent, told))) return;
    }
  }
}

PtpIpCamera::Answer PtpIpCamera::answerTo(std::uint16_t operation,
                                          const std::vector<std::uint32_t>& parameters,
                                          const Bytes& sent) {
  Answer answer;
  switch (operation) {
    case kOpenSession:
    case kCloseSession:
      return answer;
    case kGetDeviceInfo:
      return {kOk, {}, deviceInfo(), true};
    case kGetStorageIds:
      answer.has_data = true;
      put32(answer.data, 1);
      put32(answer.data, kStore);
      return answer;
    case kGetStorageInfo:
      return {kOk, {}, storageInfo(), true};
    case kGetNumObjects:
      answer.parameters.push_back(static_cast<std::uint32_t>(filesLeft()));
      return answer;
    case kInitiateCapture: {
      if (refusing_) return {kStoreFull, {}, {}, false};
      const int shot = ++shots_;
      const std::scoped_lock lock(mutex_);
      files_[static_cast<std::uint32_t>(shot)] = picture_(shot - 1);
      return answer;
    }
    case kGetPropertyDesc:
    case kGetPropertyValue:
    case kSetPropertyValue:
      return aboutProperty(operation, static_cast<std::uint16_t>(parameters[0]), sent);
    default:
      return aboutObject(operation, parameters[0], parameters);
  }
}

PtpIpCamera::Answer PtpIpCamera::aboutObject(std::uint16_t operation, std::uint32_t handle,
                                             const std::vector<std::uint32_t>&) {
  const std::scoped_lock lock(mutex_);
  Answer answer;
  if (operation == kGetObjectHandles) {
    answer.has_data = true;
    put32(answer.data, static_cast<std::uint32_t>(files_.size()));
    for (const auto& [number, file] : files_) put32(answer.data, number);
    return answer;
  }
  const auto found = files_.find(handle);
  if (operation != kGetObjectInfo && operation != kGetObject && operation != kDeleteObject) {
    return {kNotSupported, {}, {}, false};
  }
  if (found == files_.end()) return {kNoSuchHandle, {}, {}, false};
  if (operation == kGetObjectInfo) return {kOk, {}, objectInfo(handle, found->second.size()), true};
  if (operation == kGetObject) return {kOk, {}, found->second, true};
  files_.erase(found);
  return answer;
}

PtpIpCamera::Answer PtpIpCamera::aboutProperty(std::uint16_t operation, std::uint16_t code,
                                               const Bytes& sent) {
  const std::scoped_lock lock(mutex_);
  const auto found = properties_.find(code);
  if (found == properties_.end()) return {kNoSuchProperty, {}, {}, false};
  Answer answer;
  if (operation == kSetPropertyValue) {
    found->second = static_cast<std::uint16_t>(get(sent, 0, 2));
    return answer;
  }
  answer.has_data = true;
  if (operation == kGetPropertyValue) {
    put16(answer.data, found->second);
    return answer;
  }
  put16(answer.data, code);
  put16(answer.data, kUint16);
  put(answer.data, 1, 1);  // may be set
  put16(answer.data, found->second);
  put16(answer.data, found->second);
  put(answer.data, 2, 1);  // one of a list
  const auto choices = choicesOf(code);
  put16(answer.data, static_cast<std::uint16_t>(choices.size()));
  for (const std::uint16_t choice : choices) put16(answer.data, choice);
  return answer;
}

}  // namespace gyre::test
