// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/find_table.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/device/protocols/artivact_driver.h"
#include "core/device/protocols/comxim_driver.h"
#include "core/device/protocols/fabscan_driver.h"
#include "core/device/protocols/grbl_driver.h"
#include "core/device/protocols/horus_driver.h"
#include "core/device/protocols/marlin_driver.h"
#include "core/device/protocols/sardauscan_driver.h"

namespace gyre {
namespace {

constexpr double kWriteTimeout_s = 1.0;
constexpr double kSlice_s = 0.02;
constexpr double kAnswer_s = 1.0;
constexpr double kShortGreeting_s = 0.2;  // of a board that has been heard already
constexpr std::size_t kHeardKept = 200;
constexpr const char* kByItself = "(nothing)";

// In this order: a machine that may be at work is asked for its state before anything else, and
// nothing that restarts a board is sent to one that moves.
constexpr std::array<std::string_view, 7> kQuestions = {
    "?", "\x18\r\n$I\n", "M115\n", "\r\nM200\n", "sardauscan\n", "VERSION\n", ";CT();"};

bool isText(char c) { return (c >= ' ' && c <= '~') || c == '\r' || c == '\n' || c == '\t'; }

std::string printable(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    if (c != '\r') text += c >= ' ' && c <= '~' ? c : (c == '\n' ? ' ' : '.');
  }
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  text = text.substr(first, text.find_last_not_of(' ') - first + 1);
  return text.substr(0, kHeardKept);
}

// At a wrong speed bytes are as good as random, and half of those are no text.
bool legible(std::string_view bytes) {
  const auto text = std::count_if(bytes.begin(), bytes.end(), isText);
  return !bytes.empty() && static_cast<double>(text) > 0.9 * static_cast<double>(bytes.size());
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// GRBL's report of a machine that is at work.
bool tellsMotion(std::string_view heard) {
  return has(heard, "<Run|") || has(heard, "<Jog|") || has(heard, "<Home|") ||
         has(heard, "<Hold:1") || has(heard, "<Door:2") || has(heard, "<Door:3");
}

// One port at one speed.
class Listener {
 public:
  Listener(BytePort& port, int baud, const Task& task) : port_(port), baud_(baud), task_(task) {}

  // Sends the question and listens, until a known firmware has named itself or the time is over.
  Result<TableAnswer> ask(std::string_view question, double seconds) {
    heard_.clear();
    const auto bytes = std::as_bytes(std::span(question));
    if (!question.empty()) {
      if (const Result<void> sent = port_.write(bytes, kWriteTimeout_s); !sent) {
        return sent.error();
      }
    }
    const double end_s = port_.seconds() + seconds;
    while (port_.seconds() < end_s && firmware(question).empty()) {
      if (task_.stopRequested()) return cancelled();
      std::array<std::byte, 256> buffer{};
      const Result<std::size_t> count = port_.read(buffer, kSlice_s);
      if (!count) return count.error();
      for (const std::byte byte : std::span(buffer).first(*count)) {
        heard_ += static_cast<char>(byte);
      }
    }
    const std::string asked = question.empty() ? kByItself : printable(question);
    return TableAnswer{baud_, asked, printable(heard_), legible(heard_)};
  }

  // FabScan has no name of its own: it repeats the question and says that it has obeyed.
  std::string firmware(std::string_view question) const {
    const std::size_t echo = has(question, "M200") ? heard_.find("M200") : std::string::npos;
    if (echo != std::string::npos && heard_.find('>', echo) != std::string::npos) return "fabscan";
    return firmwareIn(heard_);
  }
  const std::string& heard() const { return heard_; }

 private:
  BytePort& port_;
  int baud_;
  const Task& task_;
  std::string heard_;
};

Error alreadyMoving(const std::string& port) {
  return {Error::Code::kBusy, "The board on " + port + " is moving already.",
          "Stop what drives it, then connect again."};
}

Error unknownFirmware(const std::string& port, const TableAnswer& answer) {
  return {Error::Code::kWrongDevice,
          "The device on " + port + " speaks no language that Gyre knows; it says \"" +
              answer.heard.substr(0, 60) + "\".",
          "Choose another port, or describe the table in a file (docs/user/turntables.md)."};
}

Error nobody(const std::string& port, const std::vector<TableAnswer>& answers) {
  const bool garbled =
      std::any_of(answers.begin(), answers.end(), [](const auto& a) { return !a.heard.empty(); });
  if (garbled) {
    return {Error::Code::kWrongDevice,
            "What the device on " + port + " says is garbled at every speed that was tried.",
            "Set its firmware to 115200 baud, or describe the table and its speed in a file."};
  }
  return {Error::Code::kTimeout, "Nothing answers on " + port + ".",
          "Check that the board has power and that this is its port."};
}

// An adapter that knows no such speed says so when it is set; the usual ones were tried before.
bool cannotGoSoFast(const Error& error, const TableSearch& so_far) {
  return error.code == Error::Code::kIo && so_far.error.has_value();
}

// Asks until somebody answers; empty when nobody known does.
Result<std::string> askAll(Listener& listener, double greeting_s,
                           std::vector<TableAnswer>& answers) {
  Result<TableAnswer> answer = listener.ask("", greeting_s);
  if (!answer) return answer.error();
  answers.push_back(*answer);
  std::string firmware = listener.firmware("");
  if (!firmware.empty()) return firmware;
  if (!answer->heard.empty() && !answer->legible) return firmware;  // the speed is wrong
  for (const std::string_view question : kQuestions) {
    answer = listener.ask(question, kAnswer_s);
    if (!answer) return answer.error();
    answers.push_back(*answer);
    if (tellsMotion(listener.heard())) return std::string("moving");
    firmware = listener.firmware(question);
    if (!firmware.empty()) return firmware;
  }
  return firmware;
}

}  // namespace

std::vector<std::string> firmwareWords() {
  return {"grbl", "marlin", "horus", "fabscan", "sardauscan", "artivact", "comxim"};
}

std::vector<int> usualBauds(std::string_view firmware) {
  if (firmware == "fabscan") return {57600, 115200};
  if (firmware == "marlin") return {115200, 250000};
  if (firmware == "sardauscan") return {115200, 9600};
  if (firmware == "horus") return {115200, 19200};
  if (!firmware.empty()) return {115200};
  return {115200, 57600, 250000, 9600};
}

std::unique_ptr<TableDriver> makeTableDriver(std::string_view firmware,
                                             std::unique_ptr<BytePort> port) {
  if (firmware == "grbl") return std::make_unique<GrblDriver>(std::move(port));
  if (firmware == "marlin") return std::make_unique<MarlinDriver>(std::move(port));
  if (firmware == "horus") return std::make_unique<HorusDriver>(std::move(port));
  if (firmware == "fabscan") return std::make_unique<FabScanDriver>(std::move(port));
  if (firmware == "sardauscan") return std::make_unique<SardauscanDriver>(std::move(port));
  if (firmware == "artivact") return std::make_unique<ArtivactDriver>(std::move(port));
  if (firmware == "comxim") return std::make_unique<ComXimDriver>(std::move(port));
  return nullptr;
}

std::string firmwareIn(std::string_view heard) {
  if (has(heard, "Horus 0")) return "horus";
  const bool grbl_report = has(heard, "<Idle|") || has(heard, "<Alarm|") || has(heard, "<Hold") ||
                           has(heard, "<Door") || has(heard, "<Sleep|") || has(heard, "<Check|");
  if (grbl_report || has(heard, "Grbl ") || has(heard, "GrblHAL ") || has(heard, "[VER:1.1")) {
    return "grbl";
  }
  if (has(heard, "FIRMWARE_NAME:Marlin") || has(heard, "echo:Marlin")) return "marlin";
  if (has(heard, "Sardauscan V") || heard == "yes\r\n") return "sardauscan";
  if (has(heard, "ARTIVACT_TT_V2")) return "artivact";
  return has(heard, "CR+OK;") ? "comxim" : "";
}

TableSearch findTable(const PortOpener& open, const std::vector<int>& bauds, double greeting_s,
                      const Task& task) {
  TableSearch search;
  for (std::size_t i = 0; i < bauds.size(); ++i) {
    task.report(static_cast<double>(i) / static_cast<double>(bauds.size()), "Asking who is there");
    Result<std::unique_ptr<BytePort>> port = open(bauds[i]);
    if (!port && cannotGoSoFast(port.error(), search)) continue;
    search.error = port ? std::nullopt : std::optional(port.error());
    if (!port) return search;
    const std::string name = (*port)->name();
    Listener listener(**port, bauds[i], task);
    const Result<std::string> firmware = askAll(listener, greeting_s, search.answers);
    if (!firmware || *firmware == "moving") {
      search.error = firmware ? alreadyMoving(name) : firmware.error();
      return search;
    }
    if (!firmware->empty()) {
      search.firmware = *firmware;
      search.baud = bauds[i];
      search.driver = makeTableDriver(*firmware, *std::move(port));
      const Result<void> known =
          search.driver->identify(kShortGreeting_s, [&] { return task.stopRequested(); });
      if (!known) {
        search.error = known.error();
        search.driver.reset();
      }
      return search;
    }
    const auto spoke = std::find_if(
        search.answers.begin(), search.answers.end(),
        [](const TableAnswer& answer) { return answer.legible && !answer.heard.empty(); });
    search.error = spoke == search.answers.end() ? nobody(name, search.answers)
                                                 : unknownFirmware(name, *spoke);
    if (spoke != search.answers.end()) return search;
  }
  return search;
}

TableSearch findTable(std::string_view firmware, const PortOpener& open,
                      const std::vector<int>& bauds, double greeting_s, const Task& task) {
  const DriverMaker make = [firmware](std::unique_ptr<BytePort> port) {
    return makeTableDriver(firmware, std::move(port));
  };
  TableSearch search = findTable(make, open, bauds, greeting_s, task);
  search.firmware = firmware;
  return search;
}

TableSearch findTable(const DriverMaker& make, const PortOpener& open,
                      const std::vector<int>& bauds, double greeting_s, const Task& task) {
  TableSearch search;
  for (const int baud : bauds) {
    Result<std::unique_ptr<BytePort>> port = open(baud);
    if (!port && cannotGoSoFast(port.error(), search)) continue;
    search.error = port ? std::nullopt : std::optional(port.error());
    if (!port) return search;
    search.driver = make(*std::move(port));
    search.baud = baud;
    const Result<void> known =
        search.driver->identify(greeting_s, [&] { return task.stopRequested(); });
    if (known) return search;
    search.driver.reset();
    search.error = known.error();
    const Error::Code code = known.error().code;
    if (code != Error::Code::kTimeout && code != Error::Code::kWrongDevice) return search;
  }
  return search;
}

}  // namespace gyre
