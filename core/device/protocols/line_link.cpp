// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/protocols/line_link.h"

#include <array>
#include <span>

namespace gyre {
namespace {

constexpr double kWriteTimeout_s = 1.0;
constexpr std::size_t kLongestLine = 512;  // what is longer is noise
constexpr std::size_t kHeardKept = 200;

}  // namespace

Result<void> LineLink::send(std::string_view line) {
  return sendRaw(std::string(line) + framing_.send_end);
}

Result<void> LineLink::sendRaw(std::string_view bytes) {
  return port_->write(std::as_bytes(std::span(bytes)), kWriteTimeout_s);
}

void LineLink::endLine() {
  const std::size_t first = line_.find_first_not_of(" \t");
  if (first != std::string::npos) {
    const std::size_t last = line_.find_last_not_of(" \t");
    lines_.push_back(line_.substr(first, last - first + 1));
  }
  line_.clear();
}

void LineLink::feed(char c) {
  heard_ += c >= ' ' && c <= '~' ? c : '.';
  if (framing_.ends.find(c) != std::string::npos) {
    endLine();
    return;
  }
  line_ += c;
  if (line_.size() > kLongestLine || (framing_.prompt != '\0' && line_[0] == framing_.prompt)) {
    endLine();
  }
}

Result<std::optional<std::string>> LineLink::receive(double timeout_s) {
  const double deadline_s = now() + timeout_s;
  for (;;) {
    if (!lines_.empty()) {
      std::optional<std::string> line = std::move(lines_.front());
      lines_.pop_front();
      return line;
    }
    const double left_s = deadline_s - now();
    if (left_s <= 0.0) return std::optional<std::string>();
    std::array<std::byte, 256> buffer{};
    const Result<std::size_t> count = port_->read(buffer, left_s);
    if (!count) return count.error();
    for (const std::byte byte : std::span(buffer).first(*count)) feed(static_cast<char>(byte));
    if (heard_.size() > kHeardKept) heard_.erase(0, heard_.size() - kHeardKept);
  }
}

std::string LineLink::heard() const { return heard_; }

}  // namespace gyre
