// Finds out for the window what is the matter with the ports.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QObject>
#include <QString>

#include "app/job_runner.h"
#include "core/scan/port_diagnosis.h"

namespace gyre {

// Belongs to the window's thread and never waits in it: ports are asked in a thread of its own.
// Nothing is moved, whatever answers.
class Doctor final : public QObject {
  Q_OBJECT

 public:
  explicit Doctor(QObject* parent = nullptr);

  bool busy() const { return jobs_.busy(); }

 public Q_SLOTS:
  void check(const QString& turntable);  // a turntable's word: checkPorts()
  void stop();

 Q_SIGNALS:
  void began();
  void checked(const std::vector<gyre::PortDiagnosis>& ports);
  void stopped();
  void idle();

 private:
  JobRunner jobs_;
};

}  // namespace gyre
