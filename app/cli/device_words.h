// What is known of ports and cameras, as text and as JSON.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "app/cli/console.h"
#include "core/scan/device_info.h"
#include "core/scan/port_diagnosis.h"

namespace gyre {

// A port that was listed, and what is the matter with it.
struct ListedPort {
  PortInfo info;
  PortDiagnosis diagnosis;
};

void tellPorts(Console& console, const std::vector<ListedPort>& ports,
               const std::vector<PortDiagnosis>& adapters);
void tellCameras(Console& console, const std::vector<CameraDeviceInfo>& cameras);
// What was asked and what was heard, to verbose consoles.
void tellAnswers(Console& console, const std::vector<TableAnswer>& answers);
void tellDiagnosis(Console& console, const PortDiagnosis& diagnosis);

std::string devicesJson(const std::vector<ListedPort>& ports,
                        const std::vector<PortDiagnosis>& adapters,
                        const std::vector<CameraDeviceInfo>& cameras);
std::string diagnosisJson(const PortDiagnosis& diagnosis);

}  // namespace gyre
