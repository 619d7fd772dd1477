// How the window asks a person to turn a table that has no motor.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "app/workbench.h"
#include "core/device/view_steps.h"
#include "ui/hand_card.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {

RigOptions Workbench::withPerson(RigOptions rig, PersonAtWindow& person) {
  if (!rig.ask_person) rig.ask_person = person.ask();
  return rig;
}

void Workbench::wirePerson() {
  HandCard* card = window_.work_page->hand_card;
  connect(&person_, &PersonAtWindow::asked, card, &HandCard::ask);
  connect(&person_, &PersonAtWindow::settled, card, &HandCard::settle);
  connect(card, &HandCard::done, &person_, &PersonAtWindow::done);
  connect(card, &HandCard::stopRequested, &controller_, &ScanController::stop);
  ScanPanel* scan = window_.work_page->scan_panel;
  connect(scan, &ScanPanel::viewsChanged, this, &Workbench::showViewsRemark);
  connect(&controller_.devices(), &DeviceSession::closed, this, &Workbench::showViewsRemark);
}

// A table turned by hand stands at its marks only.
void Workbench::offerMarks(double marks) {
  ScanPanel* scan = window_.work_page->scan_panel;
  const int count = static_cast<int>(marks);
  if (count > 0 && count % scan->views() != 0) scan->setViews(count);
}

// Before a scan, while another number of views can be chosen.
void Workbench::showViewsRemark() {
  ScanPanel* scan = window_.work_page->scan_panel;
  QString remark;
  if (controller_.devices().isOpen() && steps_per_turn_ > 0.0) {
    remark =
        steps_per_turn_ < scan->views()
            ? tr("⚠ This table stands still at %1 places of a turn only: take so many views, or "
                 "fewer.")
                  .arg(steps_per_turn_, 0, 'f', 0)
            : QString::fromStdString(viewStepsRemark(steps_per_turn_, scan->views()));
  }
  scan->showViewsRemark(remark);
}

}  // namespace gyre
