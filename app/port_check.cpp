// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/port_check.h"

#include <optional>
#include <utility>

#include "app/rig.h"
#include "app/table_at_port.h"
#include "core/device/discovery.h"
#include "core/device/port_doctor.h"
#include "core/device/protocol_turntable.h"

namespace gyre {
namespace {

// A port that is missing, forbidden or in use is told of without a try to open it.
PortDiagnosis chosenPort(const TurntableWord& word, const Task& task) {
  if (!word.isNetwork()) {
    PortDiagnosis closed = diagnosePort(word.port);
    if (closed.state != PortState::kReady) return closed;
  }
  return checkPort(word, task).diagnosis;
}

PortDiagnosis wrongWord(const std::string& word, const Error& error) {
  PortDiagnosis diagnosis;
  diagnosis.port = word;
  diagnosis.state = PortState::kFailed;
  diagnosis.what = error.what;
  diagnosis.advice = error.advice;
  return diagnosis;
}

}  // namespace

CheckedPort checkPort(const TurntableWord& word, const Task& task) {
  const TurntableOptions options;
  TableSearch search = searchAtPort(word, options.greeting_s, task);
  CheckedPort checked;
  std::optional<TurntableInfo> info;
  if (search.driver) {
    auto table = ProtocolTurntable::adopt(std::move(search.driver), options, task);
    if (table) {
      info = (*table)->info();
      checked.table = std::move(*table);
    } else {
      search.error = table.error();
    }
  }
  checked.diagnosis = diagnoseSearch(word.port, search, info);
  return checked;
}

std::vector<PortDiagnosis> checkPorts(const std::string& word, const Task& task) {
  std::vector<PortDiagnosis> found;
  std::string asked;
  if (!word.empty() && !namesSimulation(word)) {
    const auto parsed = turntableWord(word);
    if (!parsed) {
      found.push_back(wrongWord(word, parsed.error()));
    } else if (!parsed->port.empty()) {
      asked = parsed->port;
      found.push_back(chosenPort(*parsed, task));
    }
  }
  for (const PortInfo& port : listPorts()) {
    if (port.path != asked && port.stable_path != asked) found.push_back(diagnosePort(port.path));
  }
  for (PortDiagnosis& adapter : diagnoseAdapters()) found.push_back(std::move(adapter));
  return found;
}

}  // namespace gyre
