// Step 6: makes the surface, says what it is like, and chooses what is shown.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/mesh_panel.h"

#include <algorithm>
#include <cmath>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <QTimer>

#include "ui/health_words.h"
#include "ui/parts.h"
#include "ui/passes_card.h"
#include "ui/surface_kinds.h"

namespace gyre {
namespace {

// The slider's steps grow with the gap: from 0.1 mm to 50 mm, step 0 is automatic.
constexpr int kSliderSteps = 200;
constexpr double kLeastGap_mm = 0.1;
constexpr double kMostGap_mm = 50.0;
constexpr int kPause_ms = 40;

double gapOf(int step) {
  if (step == 0) return 0.0;
  return kLeastGap_mm *
         std::pow(kMostGap_mm / kLeastGap_mm, static_cast<double>(step) / kSliderSteps);
}

int stepOf(double gap_mm) {
  if (gap_mm < kLeastGap_mm) return 0;
  const double share = std::log(gap_mm / kLeastGap_mm) / std::log(kMostGap_mm / kLeastGap_mm);
  return std::clamp(static_cast<int>(std::lround(kSliderSteps * share)), 1, kSliderSteps);
}

}  // namespace

MeshPanel::MeshPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  addSurfaceCard(layout);
  addViewCard(layout);
  passes = new PassesCard;
  layout->addWidget(passes);
  layout->addStretch(1);
  connectAll();
  offer();
  showMethod();
  showNoMesh();
}

void MeshPanel::addSurfaceCard(QVBoxLayout* layout) {
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Surface"), "heading"));
  auto* form = new QFormLayout;
  method_ = new QComboBox;
  for (const MeshMethod kind : offeredSurfaceKinds()) {
    method_->addItem(surfaceKind(kind).name, static_cast<int>(kind));
  }
  method_->setAccessibleName(tr("Kind of surface"));
  form->addRow(tr("Kind"), method_);
  gap_mm_ = new QDoubleSpinBox;
  gap_mm_->setRange(0.0, kMostGap_mm);
  gap_mm_->setDecimals(2);
  gap_mm_->setSingleStep(0.25);
  gap_mm_->setSuffix(tr(" mm"));
  gap_mm_->setSpecialValueText(tr("automatic"));
  gap_mm_->setAccessibleName(tr("Gap size in mm"));
  gap_mm_->setToolTip(
      tr("Gaps wider than this stay open; a smaller one follows finer relief. "
         "In mm."));
  form->addRow(tr("Gap size"), gap_mm_);
  gap_slider_ = new QSlider(Qt::Horizontal);
  gap_slider_->setRange(0, kSliderSteps);
  gap_slider_->setAccessibleName(tr("Gap size"));
  gap_slider_->setToolTip(gap_mm_->toolTip());
  form->addRow(QString(), gap_slider_);
  card->addLayout(form);
  method_words_ = makeLabel(QString(), "muted");
  card->addWidget(method_words_);
  make_ = makePrimaryButton(tr("Build the surface"), tr("Wrap the points in triangles"));
  card->addWidget(make_);
  health_ = makeLabel(QString(), "muted");
  card->addWidget(health_);
}

void MeshPanel::addViewCard(QVBoxLayout* layout) {
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Show"), "heading"));
  show_ = new QComboBox;
  show_->addItems({tr("Points, natural colours"), tr("Points, ± mm as colour"), tr("Surface")});
  show_->setAccessibleName(tr("What the 3D view shows"));
  show_->setToolTip(tr("± mm: how sure each point is, one standard deviation"));
  card->addWidget(show_);
}

void MeshPanel::connectAll() {
  pause_ = new QTimer(this);
  pause_->setSingleShot(true);
  pause_->setInterval(kPause_ms);
  connect(pause_, &QTimer::timeout, this, &MeshPanel::request);
  connect(make_, &QPushButton::clicked, this, &MeshPanel::request);
  connect(method_, &QComboBox::currentIndexChanged, this, &MeshPanel::showMethod);
  connect(gap_slider_, &QSlider::valueChanged, this,
          [this](int step) { gap_mm_->setValue(gapOf(step)); });
  connect(gap_mm_, &QDoubleSpinBox::valueChanged, this, [this](double gap_mm) {
    const QSignalBlocker quiet(gap_slider_);
    gap_slider_->setValue(stepOf(gap_mm));
    if (follows_gap_) pause_->start();
  });
  connect(show_, &QComboBox::currentIndexChanged, this, [this](int index) {
    if (index == 2) {
      Q_EMIT surfaceShown();
      return;
    }
    Q_EMIT pointsShown();
    Q_EMIT coloursChosen(index == 1 ? CloudColours::kUncertainty : CloudColours::kNatural);
  });
}

bool MeshPanel::showsSurface() const { return show_->currentIndex() == 2; }

MeshMethod MeshPanel::method() const {
  return static_cast<MeshMethod>(method_->currentData().toInt());
}

void MeshPanel::showMethod() {
  const bool open = method() == MeshMethod::kAlpha;
  gap_mm_->setEnabled(open);
  gap_slider_->setEnabled(open);
  follows_gap_ = false;
  method_words_->setText(surfaceKind(method()).sentence);
}

void MeshPanel::request() {
  follows_gap_ = method() == MeshMethod::kAlpha;
  Q_EMIT meshRequested(method(), follows_gap_ ? gap_mm_->value() : 0.0);
}

void MeshPanel::showSurface(MeshMethod method, double gap_size_mm) {
  const QSignalBlocker quiet_method(method_);
  const QSignalBlocker quiet_gap(gap_mm_);
  const QSignalBlocker quiet_slider(gap_slider_);
  pause_->stop();
  method_->setCurrentIndex(method_->findData(static_cast<int>(method)));
  showMethod();
  if (method != MeshMethod::kAlpha) return;
  gap_mm_->setValue(gap_size_mm);
  gap_slider_->setValue(stepOf(gap_size_mm));
  follows_gap_ = true;
}

void MeshPanel::showPhase(ScanPhase phase) {
  phase_ = phase;
  passes->showPhase(phase);
  offer();
}

void MeshPanel::showPoints(std::size_t points) {
  points_ = points;
  offer();
}

void MeshPanel::offer() {
  const bool works = isCapturing(phase_) || phase_ == ScanPhase::kFinishing ||
                     phase_ == ScanPhase::kMeshing || phase_ == ScanPhase::kMerging ||
                     phase_ == ScanPhase::kEmptyTable || phase_ == ScanPhase::kQuickLook;
  make_->setEnabled(points_ > 0 && !works);
}

void MeshPanel::showHealth(const MeshHealth& health) {
  health_->setText(healthText(health));
  lookAtSurface();
}

void MeshPanel::lookAtSurface() { show_->setCurrentIndex(2); }

void MeshPanel::showNoMesh() {
  health_->setText(tr("No surface yet."));
  if (show_->currentIndex() == 2) show_->setCurrentIndex(0);
}

}  // namespace gyre
