// What the window remembers from one start to the next.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/settings.h"

#include <QCryptographicHash>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>

#include "core/base/address.h"

namespace gyre {
namespace {
constexpr int kMostRecent = 12;

// One word for a turntable with a camera: names of devices hold slashes, addresses hold passwords.
QString rigKey(const QString& device_id, const QString& camera) {
  const QByteArray rig =
      (device_id + '\n' + QString::fromStdString(withoutPassword(camera.toStdString()))).toUtf8();
  return QString::fromLatin1(
      QCryptographicHash::hash(rig, QCryptographicHash::Sha256).toHex().first(16));
}

QString existing(const QString& file) { return QFileInfo::exists(file) ? file : QString(); }

}  // namespace

Settings::Settings() : store_("gyre", "gyre") {}

std::vector<RecentScan> Settings::recentScans() const {
  std::vector<RecentScan> scans;
  QSettings store("gyre", "gyre");
  const int count = store.beginReadArray("recent");
  for (int i = 0; i < count; ++i) {
    store.setArrayIndex(i);
    RecentScan scan;
    scan.folder = store.value("folder").toString();
    scan.title = store.value("title").toString();
    scan.when = store.value("when").toDateTime();
    scan.size_mm = store.value("size_mm").toDouble();
    scan.thumbnail = QDir(scan.folder).filePath("thumbnail.png");
    if (QFileInfo::exists(scan.folder)) scans.push_back(scan);
  }
  return scans;
}

void Settings::rememberScan(const RecentScan& scan) {
  std::vector<RecentScan> scans = recentScans();
  std::erase_if(scans, [&](const RecentScan& other) { return other.folder == scan.folder; });
  scans.insert(scans.begin(), scan);
  if (scans.size() > kMostRecent) scans.resize(kMostRecent);
  store_.beginWriteArray("recent", static_cast<int>(scans.size()));
  for (std::size_t i = 0; i < scans.size(); ++i) {
    store_.setArrayIndex(static_cast<int>(i));
    store_.setValue("folder", scans[i].folder);
    store_.setValue("title", scans[i].title);
    store_.setValue("when", scans[i].when);
    store_.setValue("size_mm", scans[i].size_mm);
  }
  store_.endArray();
}

bool Settings::knowsTurntable(const QString& device_id) const {
  return !device_id.isEmpty() && store_.value("turntables").toStringList().contains(device_id);
}

void Settings::rememberTurntable(const QString& device_id) {
  if (device_id.isEmpty() || knowsTurntable(device_id)) return;
  store_.setValue("turntables", store_.value("turntables").toStringList() << device_id);
}

QString Settings::calibrationFor(const QString& device_id, const QString& camera) const {
  return existing(store_.value("calibrations/" + rigKey(device_id, camera)).toString());
}

void Settings::rememberCalibration(const QString& device_id, const QString& camera,
                                   const QString& file) {
  store_.setValue("calibrations/" + rigKey(device_id, camera), file);
  store_.setValue("calibration", file);
}

QString Settings::lastCalibration() const {
  return existing(store_.value("calibration").toString());
}

QString Settings::keptCalibrationFile(const QString& device_id, const QString& camera) const {
  const QString home = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
  return QDir(home).filePath("gyre/calibrations/" + rigKey(device_id, camera) + ".json");
}

ThemeChoice Settings::theme() const {
  const QString word = store_.value("theme", "system").toString();
  if (word == "light") return ThemeChoice::kLight;
  return word == "dark" ? ThemeChoice::kDark : ThemeChoice::kFollowSystem;
}

void Settings::setTheme(ThemeChoice choice) {
  store_.setValue("theme", choice == ThemeChoice::kLight  ? "light"
                           : choice == ThemeChoice::kDark ? "dark"
                                                          : "system");
}

QString Settings::turntable() const { return store_.value("turntable").toString(); }
QString Settings::camera() const { return store_.value("camera").toString(); }

void Settings::setDevices(const QString& turntable, const QString& camera) {
  store_.setValue("turntable", turntable);
  store_.setValue("camera", QString::fromStdString(withoutPassword(camera.toStdString())));
}

QString Settings::newScanFolder(const QString& title) const {
  const QString home = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  const QString time = QDateTime::currentDateTime().toString("yyyy-MM-dd HHmmss");
  return QDir(home).filePath(QString("Gyre/%1 %2").arg(title, time));
}

}  // namespace gyre
