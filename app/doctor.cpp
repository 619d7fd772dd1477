// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/doctor.h"

#include <memory>

#include "app/port_check.h"

namespace gyre {

Doctor::Doctor(QObject* parent) : QObject(parent), jobs_("gyre-doctor") {
  connect(&jobs_, &JobRunner::idle, this, &Doctor::idle);
}

void Doctor::check(const QString& turntable) {
  if (busy()) return;
  Q_EMIT began();
  auto found = std::make_shared<std::vector<PortDiagnosis>>();
  jobs_.start(
      [found, word = turntable.toStdString()](const Task& task) -> Result<void> {
        *found = checkPorts(word, task);
        return task.stopRequested() ? Result<void>(cancelled()) : Result<void>();
      },
      [this, found](const Result<void>& outcome) {
        if (outcome) {
          Q_EMIT checked(*found);
        } else {
          Q_EMIT stopped();
        }
      });
}

void Doctor::stop() { jobs_.requestStop(); }

}  // namespace gyre
