// What the window tells of ports that do not answer as a turntable.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/workbench.h"
#include "ui/device_panel.h"
#include "ui/work_page.h"

namespace gyre {

void Workbench::wireDoctor() {
  DevicePanel* panel = window_.work_page->device_panel;
  connect(panel, &DevicePanel::checkRequested, &doctor_, &Doctor::check);
  connect(panel, &DevicePanel::checkStopRequested, &doctor_, &Doctor::stop);
  connect(&doctor_, &Doctor::began, panel, &DevicePanel::showChecking);
  connect(&doctor_, &Doctor::checked, panel, &DevicePanel::showChecked);
  connect(&doctor_, &Doctor::stopped, panel, &DevicePanel::showCheckStopped);
  connect(&doctor_, &Doctor::idle, this, &Workbench::closeWhenQuiet);
  connect(&window_, &MainWindow::closeRequested, &doctor_, &Doctor::stop);
}

}  // namespace gyre
