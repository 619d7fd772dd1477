// What the window remembers from one start to the next.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QSettings>
#include <QString>

#include "ui/facts.h"
#include "ui/theme.h"

namespace gyre {

// Kept where the desktop keeps such things. Passwords in camera addresses are not.
class Settings final {
 public:
  Settings();

  // Newest first, at most twelve, only folders that are still there.
  std::vector<RecentScan> recentScans() const;
  void rememberScan(const RecentScan& scan);

  // A turntable that the user has once called so.
  bool knowsTurntable(const QString& device_id) const;
  void rememberTurntable(const QString& device_id);

  // The calibration that was kept last for this turntable and camera; empty when there is none, or
  // when its file is gone.
  QString calibrationFor(const QString& device_id, const QString& camera) const;
  void rememberCalibration(const QString& device_id, const QString& camera, const QString& file);
  // The one that was kept last for any.
  QString lastCalibration() const;
  // Where a calibration of this rig is kept; the folder is made by whoever writes it.
  QString keptCalibrationFile(const QString& device_id, const QString& camera) const;

  ThemeChoice theme() const;
  void setTheme(ThemeChoice choice);

  QString turntable() const;
  QString camera() const;
  void setDevices(const QString& turntable, const QString& camera);

  // A folder for a new scan, named by what is scanned and the time; it is not made.
  QString newScanFolder(const QString& title) const;

 private:
  QSettings store_;
};

}  // namespace gyre
