// Exchanges with a GRBL board over any port: each has a deadline, an interruption and one result.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/device/byte_port.h"
#include "core/device/interrupted.h"
#include "core/device/protocols/grbl.h"

namespace gyre {

// One thread at a time.
class GrblLink {
 public:
  explicit GrblLink(std::unique_ptr<BytePort> port) : port_(std::move(port)) {}

  // Sends a line and waits for its ok. kRejected when the board answers error:N, kTimeout when it
  // answers nothing that can be read, kGone when the port is gone, and what trouble() tells.
  Result<void> command(std::string_view line, double timeout_s, const Interrupted& interrupted);

  // The same, and what was said before the ok.
  Result<std::vector<GrblMessage>> query(std::string_view line, double timeout_s,
                                         const Interrupted& interrupted);

  // Asks for the status, again after each quarter of the time-out. Positions are machine positions,
  // in the unit of the settings.
  Result<GrblStatus> status(double timeout_s, const Interrupted& interrupted);

  // Sends realtime characters, or a line whose answer the caller awaits by receive().
  Result<void> send(std::string_view text);
  // The next message that comes within the time; nothing when none does.
  Result<std::optional<GrblMessage>> receive(double timeout_s);
  // Drops what comes until the line is quiet; alarms and banners are noted, not dropped.
  Result<void> drain();

  // kAlarm once the board has restarted or raised an alarm, until forgiveTrouble(). Every exchange
  // but send(), receive() and drain() fails with it.
  const std::optional<Error>& trouble() const { return trouble_; }
  void forgiveTrouble() { trouble_.reset(); }
  // Whether the board has raised an alarm of its limits and not restarted since: then it stands and
  // hears nothing but a reset, not even the question for its status.
  bool needsReset() const { return needs_reset_; }
  // How often the board has raised an alarm since the port was opened.
  int alarms() const { return alarms_; }

  // Reports in inches ($13=1) are scaled to the unit of the settings.
  void setReportScale(double scale) { report_scale_ = scale; }
  // The latest lines that were no GRBL messages: what a foreign device said.
  const std::string& garbage() const { return garbage_; }
  std::string name() const { return port_->name(); }
  double now() const { return port_->seconds(); }  // by the port's clock

 private:
  void note(GrblMessage& message);
  void completePosition(GrblStatus& status);
  Error silence() const;

  std::unique_ptr<BytePort> port_;
  GrblParser parser_;
  std::optional<Error> trouble_;
  bool needs_reset_ = false;
  int alarms_ = 0;
  std::vector<double> work_offset_;
  double report_scale_ = 1.0;
  std::string garbage_;
};

}  // namespace gyre
