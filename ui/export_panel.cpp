// Step 7: files for other programs.
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
  surface_ = {
      addFormat(Content::kSurface, "PLY", tr("Triangles with colours and ± mm")),
      addFormat(Content::kSurface, "OBJ", tr("Triangles with colours")),
      addFormat(Content::kSurface, "STL", tr("For printing: triangles that stand on the bed")),
      addFormat(Content::kSurface, "3MF", tr("For printing: on the bed, with colours and unit")),
      addFormat(Content::kSurface, "GLB", tr("For viewers and web pages: metres, Y up, colours")),
  };
  points_ = addFormat(Content::kPoints, "PLY", tr("Points with colours, normals and ± mm"));
  for (QPushButton* button : surface_) card->addWidget(button);
  card->addWidget(points_);
  card->addWidget(makeRule());
  written_ = makeLabel(QString(), "muted");
  written_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  card->addWidget(written_);
  open_ = makeButton(tr("Open in its program"),
                     tr("Opens the written file in the program that this computer has for it"));
  open_->setEnabled(false);
  card->addWidget(open_);
  layout->addStretch(1);
  connect(open_, &QPushButton::clicked, this, [this] { Q_EMIT openRequested(written_path_); });
  showAvailable(0, 0);
}

QPushButton* ExportPanel::addFormat(Content content, const QString& format, const QString& tip) {
  QPushButton* button = makeButton(content == Content::kPoints ? tr("Points as %1…").arg(format)
                                                               : tr("Surface as %1…").arg(format),
                                   tip);
  connect(button, &QPushButton::clicked, this, [this, content, format] { ask(content, format); });
  return button;
}

void ExportPanel::ask(Content content, const QString& format) {
  const QString ending = format.toLower();
  auto* dialog = new QFileDialog(this, tr("Export"), folder_, format + " (*." + ending + ")");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(ending);
  dialog->selectFile((content == Content::kPoints ? "points." : "mesh.") + ending);
  connect(dialog, &QFileDialog::fileSelected, this, [this, content](const QString& path) {
    if (content == Content::kPoints) {
      Q_EMIT pointsExportRequested(path);
    } else {
      Q_EMIT meshExportRequested(path);
    }
  });
  dialog->open();
}

void ExportPanel::showAvailable(std::size_t points, std::size_t triangles) {
  points_->setEnabled(points > 0);
  for (QPushButton* button : surface_) button->setEnabled(triangles > 0);
}

void ExportPanel::showWritten(const QString& path) {
  written_path_ = path;
  written_->setText(tr("✓ Written: %1").arg(path));
  open_->setEnabled(true);
}

void ExportPanel::setFolder(const QString& folder) { folder_ = folder; }

}  // namespace gyre
