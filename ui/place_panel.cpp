// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/place_panel.h"

#include "ui/parts.h"
#include "ui/quick_look_card.h"

namespace gyre {

PlacePanel::PlacePanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGap_px);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("The empty table"), "heading"));
  card->addWidget(
      makeLabel(tr("Take everything off the table. A picture of it tells the object "
                   "from the ground it stands on.")));
  take_ = makeButton(tr("Take the picture"), tr("Take a picture of the empty table"));
  card->addWidget(take_);
  taken_ = makeLabel(QString(), "muted");
  card->addWidget(taken_);
  QVBoxLayout* object = nullptr;
  layout->addWidget(makeCard(object));
  object->addWidget(makeLabel(tr("The object"), "heading"));
  object->addWidget(
      makeLabel(tr("Put the object in the middle of the table. From here on, the "
                   "camera may not be touched.")));
  usable_ = makeLabel(QString(), "muted");
  object->addWidget(usable_);
  quick_look = new QuickLookCard;
  layout->addWidget(quick_look);
  placed_ = makePrimaryButton(tr("The object is in place"), tr("Go on to the scan"));
  layout->addWidget(placed_);
  layout->addStretch(1);
  connect(take_, &QPushButton::clicked, this, &PlacePanel::emptyTableRequested);
  connect(placed_, &QPushButton::clicked, this, &PlacePanel::objectPlaced);
  showUsable(std::nullopt);
  reset();
}

void PlacePanel::showPhase(ScanPhase phase) {
  const bool at_rest =
      phase == ScanPhase::kReady || phase == ScanPhase::kDone || phase == ScanPhase::kFailed;
  take_->setEnabled(at_rest);
  placed_->setEnabled(at_rest);
  quick_look->showPhase(phase);
}

void PlacePanel::showEmptyTableTaken() { taken_->setText(tr("✓ The empty table has been seen.")); }

void PlacePanel::showUsable(const std::optional<UsableCylinder>& cylinder) {
  usable_->setText(cylinder
                       ? tr("It stays in the picture at every angle inside the cylinder that is "
                            "drawn: %1 mm wide and %2 mm high. What is narrower may be higher.")
                             .arg(2.0 * cylinder->radius_mm, 0, 'f', 0)
                             .arg(cylinder->height_mm, 0, 'f', 0)
                       : tr("Where it stays in the picture is drawn once camera and table are "
                            "calibrated."));
}

void PlacePanel::reset() {
  quick_look->showLook(nullptr);
  taken_->setText(
      tr("Without it, the object is told from what stands still while the table turns."));
}

}  // namespace gyre
