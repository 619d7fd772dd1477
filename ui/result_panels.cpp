// The panels of steps 5 and 6: surface and export.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLocale>

#include "ui/parts.h"
#include "ui/step_panels.h"

namespace gyre {

MeshPanel::MeshPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Surface"), "heading"));
  auto* form = new QFormLayout;
  gap_mm_ = new QDoubleSpinBox;
  gap_mm_->setRange(0.0, 50.0);
  gap_mm_->setDecimals(2);
  gap_mm_->setSingleStep(0.25);
  gap_mm_->setSuffix(tr(" mm"));
  gap_mm_->setSpecialValueText(tr("automatic"));
  gap_mm_->setAccessibleName(tr("Gap size in mm"));
  gap_mm_->setToolTip(
      tr("Gaps wider than this stay open; a smaller one follows finer relief. "
         "In mm."));
  form->addRow(tr("Gap size"), gap_mm_);
  card->addLayout(form);
  make_ = makePrimaryButton(tr("Build the surface"), tr("Wrap the points in triangles"));
  card->addWidget(make_);
  health_ = makeLabel(QString(), "muted");
  card->addWidget(health_);
  QVBoxLayout* view = nullptr;
  layout->addWidget(makeCard(view));
  view->addWidget(makeLabel(tr("Show"), "heading"));
  show_ = new QComboBox;
  show_->addItems({tr("Points, natural colours"), tr("Points, ± mm as colour"), tr("Surface")});
  show_->setAccessibleName(tr("What the 3D view shows"));
  show_->setToolTip(tr("± mm: how sure each point is, one standard deviation"));
  view->addWidget(show_);
  layout->addStretch(1);
  connect(make_, &QPushButton::clicked, this, [this] { Q_EMIT meshRequested(gap_mm_->value()); });
  connect(show_, &QComboBox::currentIndexChanged, this, [this](int index) {
    if (index == 2) {
      Q_EMIT surfaceShown();
      return;
    }
    Q_EMIT pointsShown();
    Q_EMIT coloursChosen(index == 1 ? CloudColours::kUncertainty : CloudColours::kNatural);
  });
  showNoMesh();
}

void MeshPanel::showPhase(ScanPhase phase) { make_->setEnabled(phase == ScanPhase::kDone); }

void MeshPanel::showHealth(const MeshHealth& health) {
  const QLocale locale;
  QString text = tr("%1 vertices, %2 triangles, %3 cm²")
                     .arg(locale.toString(static_cast<qulonglong>(health.vertices)),
                          locale.toString(static_cast<qulonglong>(health.triangles)))
                     .arg(health.area_mm2 / 100.0, 0, 'f', 1);
  text += health.closed
              ? tr("\n✓ closed")
              : tr("\n⚠ open: it has %1 edges with nothing beyond").arg(health.boundary_edges);
  text += health.components == 1 ? tr("\n✓ one piece") : tr("\n⚠ %1 pieces").arg(health.components);
  health_->setText(text);
  show_->setCurrentIndex(2);
}

void MeshPanel::showNoMesh() {
  health_->setText(tr("No surface yet."));
  if (show_->currentIndex() == 2) show_->setCurrentIndex(0);
}

ExportPanel::ExportPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Files for other programs"), "heading"));
  card->addWidget(makeLabel(tr("In millimetres, Z up, standing on the table."), "muted"));
  ply_ = makeButton(tr("Surface as PLY…"), tr("Triangles with colours and ± mm"));
  obj_ = makeButton(tr("Surface as OBJ…"), tr("Triangles with colours"));
  points_ = makeButton(tr("Points as PLY…"), tr("Points with colours, normals and ± mm"));
  for (QPushButton* button : {ply_, obj_, points_}) card->addWidget(button);
  written_ = makeLabel(QString(), "muted");
  written_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  card->addWidget(written_);
  layout->addStretch(1);
  connect(ply_, &QPushButton::clicked, this, [this] { ask("mesh.ply", tr("PLY (*.ply)")); });
  connect(obj_, &QPushButton::clicked, this, [this] { ask("mesh.obj", tr("OBJ (*.obj)")); });
  connect(points_, &QPushButton::clicked, this, [this] { ask("points.ply", tr("PLY (*.ply)")); });
  showAvailable(0, 0);
}

void ExportPanel::ask(const char* kind, const QString& filter) {
  const QString path =
      QFileDialog::getSaveFileName(this, tr("Export"), QDir(folder_).filePath(kind), filter);
  if (path.isEmpty()) return;
  if (QString(kind) == "points.ply") {
    Q_EMIT pointsExportRequested(path);
  } else {
    Q_EMIT meshExportRequested(path);
  }
}

void ExportPanel::showAvailable(std::size_t points, std::size_t triangles) {
  points_->setEnabled(points > 0);
  ply_->setEnabled(triangles > 0);
  obj_->setEnabled(triangles > 0);
}

void ExportPanel::showWritten(const QString& path) {
  written_->setText(tr("✓ Written: %1").arg(path));
}

void ExportPanel::setFolder(const QString& folder) { folder_ = folder; }

}  // namespace gyre
