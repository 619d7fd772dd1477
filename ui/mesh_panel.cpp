// Step 5: makes the surface, says what it is like, and chooses what is shown.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/mesh_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLocale>

#include "ui/parts.h"

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

}  // namespace gyre
