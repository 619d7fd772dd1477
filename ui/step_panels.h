// The panels of steps 2 to 6: calibration, placing, scan, surface, export.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/scan/calibration.h"
#include "core/scan/mesh_health.h"
#include "ui/cloud_actors.h"
#include "ui/facts.h"

class QButtonGroup;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace gyre {

// Step 2. Shows what is known of camera and table, and takes it from a file.
class CalibrationPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit CalibrationPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showCalibration(const gyre::Calibration& calibration, const QString& source);
  void showNone();

 Q_SIGNALS:
  void fileChosen(const QString& path);

 private:
  QLabel* source_;
  QLabel* figures_;
};

// Step 3. The bare table is looked at once, then the object is put on it.
class PlacePanel final : public QWidget {
  Q_OBJECT

 public:
  explicit PlacePanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showEmptyTableTaken();
  void reset();

 Q_SIGNALS:
  void emptyTableRequested();
  void objectPlaced();

 private:
  QPushButton* take_;
  QLabel* taken_;
  QPushButton* placed_;
};

// Step 4. How many views, and where they are kept.
class ScanPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit ScanPanel(QWidget* parent = nullptr);

  int views() const;
  QString folder() const;
  void setFolder(const QString& folder);
  void setViews(int views);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  // What one view takes, so that the cost is known before it is paid.
  void showCost(double seconds_per_view, double megabytes_per_view);

 Q_SIGNALS:
  void startRequested();
  void resumeRequested();

 private:
  void showEstimate();

  QButtonGroup* kind_;
  QSpinBox* views_;
  QLineEdit* folder_;
  QLabel* estimate_;
  QPushButton* start_;
  QPushButton* resume_;
  double seconds_per_view_ = 0.0;
  double megabytes_per_view_ = 0.0;
};

// Step 5. Makes the surface and says what it is like.
class MeshPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit MeshPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showHealth(const gyre::MeshHealth& health);
  void showNoMesh();

 Q_SIGNALS:
  void meshRequested(double gap_size_mm);  // 0: the program's choice
  void coloursChosen(gyre::CloudColours colours);
  void surfaceShown();
  void pointsShown();

 private:
  QDoubleSpinBox* gap_mm_;
  QPushButton* make_;
  QComboBox* show_;
  QLabel* health_;
};

// Step 6. Files for other programs.
class ExportPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit ExportPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showAvailable(std::size_t points, std::size_t triangles);
  void showWritten(const QString& path);
  void setFolder(const QString& folder);

 Q_SIGNALS:
  void pointsExportRequested(const QString& path);  // .ply
  void meshExportRequested(const QString& path);    // .ply or .obj by its ending

 private:
  void ask(const char* kind, const QString& filter);

  QPushButton* points_;
  QPushButton* ply_;
  QPushButton* obj_;
  QLabel* written_;
  QString folder_;
};

}  // namespace gyre
