// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/quick_look_card.h"

#include <QGridLayout>
#include <QPainter>
#include <QScrollArea>
#include <QTimer>

#include "ui/parts.h"
#include "ui/theme.h"

namespace gyre {
namespace {

constexpr int kThumbnailWidth_px = 128;
constexpr int kColumns = 2;
constexpr int kFrame_px = 3;

// A sign and a word: the sign tells it without the colour.
QString verdictWords(QuickVerdict verdict) {
  switch (verdict) {
    case QuickVerdict::kGood:
      return QuickLookCard::tr("✓ Good: scan it.");
    case QuickVerdict::kAcceptable:
      return QuickLookCard::tr("△ Acceptable: it can be scanned.");
    case QuickVerdict::kRedo:
      return QuickLookCard::tr("✗ Better mend this first.");
  }
  return {};
}

QString signOf(QuickVerdict verdict) {
  return verdict == QuickVerdict::kGood         ? QString::fromUtf8("✓")
         : verdict == QuickVerdict::kAcceptable ? QString::fromUtf8("△")
                                                : QString::fromUtf8("✗");
}

QColor colourOf(QuickVerdict verdict) {
  const ThemeColours colours = themeColours();
  return verdict == QuickVerdict::kGood         ? colours.good
         : verdict == QuickVerdict::kAcceptable ? colours.warning
                                                : colours.bad;
}

QPixmap thumbnailOf(const QuickView& view) {
  const cv::Mat& mat = view.picture->image_bgr;
  const QImage image(mat.data, mat.cols, mat.rows, static_cast<qsizetype>(mat.step[0]),
                     QImage::Format_BGR888);
  QPixmap small =
      QPixmap::fromImage(image.scaledToWidth(kThumbnailWidth_px, Qt::SmoothTransformation));
  QPainter painter(&small);
  painter.setPen(QPen(colourOf(view.verdict), kFrame_px));
  painter.drawRect(small.rect().adjusted(1, 1, -2, -2));
  return small;
}

}  // namespace

QuickLookCard::QuickLookCard(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  auto* card = new QVBoxLayout(this);
  card->setContentsMargins(16, 14, 16, 14);
  card->setSpacing(kGap_px - 4);
  card->addWidget(makeLabel(tr("Quick look"), "heading"));
  card->addWidget(
      makeLabel(tr("The table turns once, in about 20 seconds. Eight pictures tell whether the "
                   "object will scan well.")));
  look_ = makeButton(tr("Look around the object"),
                     tr("Turn the table once and judge eight pictures; nothing is kept"));
  card->addWidget(look_);
  verdict_ = makeLabel(QString(), "heading");
  verdict_->setAccessibleName(tr("What the quick look found"));
  findings_ = makeLabel(QString());
  findings_->setTextFormat(Qt::RichText);
  pictures_text_ = makeLabel(tr("Pictures that are not good:"), "muted");
  pictures_ = new QWidget;
  grid_ = new QGridLayout(pictures_);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(6);
  for (QWidget* part : {static_cast<QWidget*>(verdict_), static_cast<QWidget*>(findings_),
                        static_cast<QWidget*>(pictures_text_), pictures_}) {
    card->addWidget(part);
  }
  connect(look_, &QPushButton::clicked, this, [this] {
    if (phase_ == ScanPhase::kQuickLook) {
      Q_EMIT stopRequested();
    } else {
      Q_EMIT lookRequested();
    }
  });
  showPhase(ScanPhase::kIdle);
  showLook(nullptr);
}

void QuickLookCard::showPhase(ScanPhase phase) {
  phase_ = phase;
  const bool looking = phase == ScanPhase::kQuickLook;
  const bool at_rest =
      phase == ScanPhase::kReady || phase == ScanPhase::kDone || phase == ScanPhase::kFailed;
  look_->setText(looking ? tr("Stop the table") : tr("Look around the object"));
  look_->setEnabled(at_rest || looking);
  if (phase == ScanPhase::kIdle) showLook(nullptr);
}

void QuickLookCard::showLook(const QuickLookPtr& look) {
  for (QWidget* part : {static_cast<QWidget*>(verdict_), static_cast<QWidget*>(findings_),
                        static_cast<QWidget*>(pictures_text_), pictures_}) {
    part->setVisible(look != nullptr);
  }
  if (!look) return;
  verdict_->setText(verdictWords(look->verdict));
  QString text;
  for (const QuickFinding& finding : look->findings) {
    if (!text.isEmpty()) text += "<br>";
    text += QString("<span style='color:%1'>%2</span> %3")
                .arg(colourOf(finding.verdict).name(), signOf(finding.verdict),
                     QString::fromStdString(finding.sentence).toHtmlEscaped());
    if (!finding.advice.empty()) {
      text += " <b>" + QString::fromStdString(finding.advice).toHtmlEscaped() + "</b>";
    }
  }
  findings_->setText(text);
  showPictures(*look);
  QTimer::singleShot(0, this, &QuickLookCard::reveal);  // once it is laid out
}

// What was asked for is seen, however small the window is.
void QuickLookCard::reveal() {
  for (QWidget* above = parentWidget(); above != nullptr; above = above->parentWidget()) {
    if (auto* scroll = qobject_cast<QScrollArea*>(above)) {
      scroll->ensureWidgetVisible(findings_);
      return;
    }
  }
}

void QuickLookCard::showPictures(const QuickLook& look) {
  while (QLayoutItem* old = grid_->takeAt(0)) {
    delete old->widget();
    delete old;
  }
  int shown = 0;
  for (std::size_t i = 0; i < look.views.size(); ++i) {
    const QuickView& view = look.views[i];
    if (view.verdict == QuickVerdict::kGood) continue;
    const QString why = tr("%1: %2").arg(i + 1).arg(QString::fromStdString(view.fault));
    auto* cell = new QWidget;
    auto* column = new QVBoxLayout(cell);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    auto* picture = new QLabel;
    picture->setPixmap(thumbnailOf(view));
    picture->setAccessibleName(tr("Picture %1").arg(why));
    column->addWidget(picture);
    column->addWidget(makeLabel(why, "muted"));
    grid_->addWidget(cell, shown / kColumns, shown % kColumns, Qt::AlignTop);
    ++shown;
  }
  pictures_->setVisible(shown > 0);
  pictures_text_->setVisible(shown > 0);
}

}  // namespace gyre
