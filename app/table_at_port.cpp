// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/table_at_port.h"

#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "core/device/protocols/described_driver.h"
#include "core/device/serial_port.h"
#include "core/device/tcp_port.h"
#include "core/device/wire_log.h"
#include "core/io/turntable_file.h"

namespace gyre {
namespace {

constexpr double kConnect_s = 5.0;

Result<std::unique_ptr<BytePort>> openWire(const TurntableWord& word, int baud) {
  if (word.isNetwork()) {
    auto port = TcpPort::open(word.port, kConnect_s);
    if (!port) return port.error();
    return std::unique_ptr<BytePort>(std::move(port).value());
  }
  auto port = SerialPort::open(word.port, baud);
  if (!port) return port.error();
  return std::unique_ptr<BytePort>(std::move(port).value());
}

std::filesystem::path cacheFolder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache == '/') return std::filesystem::path(cache) / "gyre";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return std::filesystem::path(home) / ".cache" / "gyre";
  std::error_code failed;
  return std::filesystem::temp_directory_path(failed) / "gyre-cache";
}

PortOpener openerFor(const TurntableWord& word) {
  auto log = WireLog::open(wireLogFile(word.port));
  const std::shared_ptr<WireLog> kept = log ? *log : nullptr;
  return [word, kept](int baud) -> Result<std::unique_ptr<BytePort>> {
    auto wire = openWire(word, baud);
    if (kept) {
      kept->note('=', wire ? "speed " + std::to_string(baud) : wire.error().what);
    }
    if (!wire || !kept) return wire;
    return std::unique_ptr<BytePort>(std::make_unique<LoggedPort>(std::move(*wire), kept));
  };
}

}  // namespace

std::filesystem::path wireLogFile(const std::string& port) {
  std::string name;
  for (const char c : port) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    name += plain || c == '.' ? c : '-';
  }
  return cacheFolder() / ("wire" + std::string(name.starts_with('-') ? "" : "-") + name + ".log");
}

TableSearch searchAtPort(const TurntableWord& word, double greeting_s, const Task& task) {
  TableSearch failed;
  std::vector<int> bauds = word.isNetwork() ? std::vector<int>{0} : usualBauds(word.firmware);
  if (word.description.empty()) {
    const PortOpener open = openerFor(word);
    return word.firmware.empty() ? findTable(open, bauds, greeting_s, task)
                                 : findTable(word.firmware, open, bauds, greeting_s, task);
  }
  auto description = readTurntableDescription(word.description);
  if (!description) {
    failed.error = description.error();
    return failed;
  }
  if (!word.isNetwork()) bauds = {description->baud};
  const DriverMaker make = [&](std::unique_ptr<BytePort> port) -> std::unique_ptr<TableDriver> {
    return std::make_unique<DescribedDriver>(std::move(port), *description);
  };
  TableSearch search = findTable(make, openerFor(word), bauds, greeting_s, task);
  search.firmware = description->name;
  return search;
}

}  // namespace gyre
