// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/place_page.h"

#include <QVBoxLayout>

#include "ui/parts.h"
#include "ui/target_drawing.h"

namespace gyre {

PlaceTargetPage::PlaceTargetPage()
    : WizardPage(tr("Put the target on the table"), "place",
                 tr("Take the object off and stand the target in the middle. It must lie still, "
                    "be sharp and be seen whole.")) {
  faces_ = makeLabel(QString());
  faces_->setAccessibleName(tr("Faces of the target that are seen"));
  sentence_ = makeLabel(QString(), "muted");
  asking_ = makeLabel(QString());
  asking_->setAccessibleName(tr("Corner to click"));
  drawing_ = new TargetDrawing;
  hand_ = makeButton(QString(), tr("Click six corners of the target in the picture"));
  body().addWidget(faces_);
  body().addWidget(sentence_);
  body().addWidget(asking_);
  body().addWidget(drawing_);
  body().addWidget(hand_);
  body().addStretch(1);
  connect(hand_, &QPushButton::clicked, this, [this] {
    if (clicking_) {
      Q_EMIT handCancelled();
    } else {
      Q_EMIT handRequested();
    }
  });
  hand_->hide();
  reset();
}

void PlaceTargetPage::showSight(const TargetSight& sight) {
  QStringList lines;
  for (std::size_t face = 0; face < sight.faces.size(); ++face) {
    const FaceSight& seen = sight.faces[face];
    const QString sign = seen.passes ? "✓" : seen.seen > 0 ? "△" : "–";
    lines.append(
        tr("%1 Face %2: %3 of %4 points").arg(sign).arg(face + 1).arg(seen.seen).arg(seen.points));
  }
  faces_->setText(lines.join('\n'));
  const QString sentence = QString::fromStdString(sight.sentence);
  sentence_->setText(sentence);
  hindrance_ = sight.passes         ? QString()
               : sentence.isEmpty() ? tr("The target is not seen well enough yet.")
                                    : sentence;
  Q_EMIT hindranceChanged();
}

void PlaceTargetPage::showSketch(const TargetSketch& sketch) {
  sketch_ = sketch;
  showAsked({});
}

void PlaceTargetPage::showAsked(std::optional<int> asked) {
  clicking_ = asked.has_value();
  hand_->setVisible(!sketch_.to_click.empty());
  hand_->setText(clicking_ ? tr("Stop &clicking") : tr("Show it by &hand…"));
  asking_->setVisible(clicking_);
  drawing_->setVisible(clicking_);
  if (!clicking_) return;
  asking_->setText(tr("Turn the target until it looks as in the drawing. Then click the ringed "
                      "corner in the picture: %1 of %2.")
                       .arg(*asked + 1)
                       .arg(sketch_.to_click.size()));
  drawing_->ask(sketch_, *asked);
}

void PlaceTargetPage::reset() {
  showAsked({});
  faces_->clear();
  sentence_->setText(tr("Looking for the target…"));
  hindrance_ = tr("The target has not been seen yet.");
  Q_EMIT hindranceChanged();
}

}  // namespace gyre
