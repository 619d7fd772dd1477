// Step 6: files for other programs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export_panel.h"

#include <QDir>
#include <QFileDialog>

#include "ui/parts.h"

namespace gyre {

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
