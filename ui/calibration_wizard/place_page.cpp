// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/calibration_wizard/place_page.h"

#include <QVBoxLayout>

#include "ui/parts.h"

namespace gyre {

PlaceTargetPage::PlaceTargetPage()
    : WizardPage(tr("Put the target on the table"), "place",
                 tr("Take the object off and stand the target in the middle. It must lie still, "
                    "be sharp and be seen whole.")) {
  faces_ = makeLabel(QString());
  faces_->setAccessibleName(tr("Faces of the target that are seen"));
  sentence_ = makeLabel(QString(), "muted");
  body().addWidget(faces_);
  body().addWidget(sentence_);
  body().addStretch(1);
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

void PlaceTargetPage::reset() {
  faces_->clear();
  sentence_->setText(tr("Looking for the target…"));
  hindrance_ = tr("The target has not been seen yet.");
  Q_EMIT hindranceChanged();
}

}  // namespace gyre
