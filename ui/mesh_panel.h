// Step 6: makes the surface, says what it is like, and chooses what is shown.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <QWidget>

#include "core/scan/mesh_health.h"
#include "core/scan/mesh_method.h"
#include "ui/cloud_actors.h"
#include "ui/facts.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSlider;
class QTimer;
class QVBoxLayout;

namespace gyre {

class PassesCard;

class MeshPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit MeshPanel(QWidget* parent = nullptr);

  PassesCard* passes;  // a child

  // False while the points are to be seen in the 3D view.
  bool showsSurface() const;

 public Q_SLOTS:
  void showPhase(gyre::ScanPhase phase);
  void showPoints(std::size_t points);  // how many there are to make a surface of
  // Shows the choice that made the surface, without asking for another.
  void showSurface(gyre::MeshMethod method, double gap_size_mm);
  void showHealth(const gyre::MeshHealth& health);
  void lookAtSurface();  // as if chosen in the list of views
  void showNoMesh();

 Q_SIGNALS:
  void meshRequested(gyre::MeshMethod method, double gap_size_mm);  // 0: the program's choice
  void coloursChosen(gyre::CloudColours colours);
  void surfaceShown();
  void pointsShown();

 private:
  void addSurfaceCard(QVBoxLayout* layout);
  void addViewCard(QVBoxLayout* layout);
  void connectAll();
  MeshMethod method() const;
  void showMethod();
  void request();
  void offer();

  QComboBox* method_;
  QLabel* method_words_;
  QDoubleSpinBox* gap_mm_;
  QSlider* gap_slider_;
  QTimer* pause_;             // between the last move of the slider and the surface
  bool follows_gap_ = false;  // an alpha shape is shown
  QPushButton* make_;
  QComboBox* show_;
  QLabel* health_;
  ScanPhase phase_ = ScanPhase::kIdle;
  std::size_t points_ = 0;
};

}  // namespace gyre
