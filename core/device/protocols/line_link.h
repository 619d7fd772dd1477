// Words to and from a firmware that is spoken to in lines, over any port.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "core/device/byte_port.h"

namespace gyre {

// How a firmware divides the stream.
struct LineFraming {
  std::string send_end = "\n";  // after what is sent
  std::string ends = "\r\n";    // each of these ends what is heard
  char prompt = '\0';           // heard at the start of a line, it is a line of its own
};

// One thread at a time. Resynchronises at the next end of line after anything.
class LineLink {
 public:
  LineLink(std::unique_ptr<BytePort> port, LineFraming framing)
      : port_(std::move(port)), framing_(std::move(framing)) {}

  // Sends the line and its end.
  Result<void> send(std::string_view line);
  // Sends these bytes as they are.
  Result<void> sendRaw(std::string_view bytes);
  // The next line that is not empty; nothing when none comes within the time.
  Result<std::optional<std::string>> receive(double timeout_s);

  // What was heard lately, with anything unprintable as dots: to tell what a foreign device said.
  std::string heard() const;
  std::string name() const { return port_->name(); }
  double now() const { return port_->seconds(); }

 private:
  void feed(char c);
  void endLine();

  std::unique_ptr<BytePort> port_;
  LineFraming framing_;
  std::string line_;
  std::deque<std::string> lines_;
  std::string heard_;
};

}  // namespace gyre
