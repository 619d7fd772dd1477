// The first page: try the demo, begin a scan, open one, or go on with a recent one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/start_page.h"

#include <QAbstractButton>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QPainter>
#include <QVBoxLayout>

#include "ui/parts.h"
#include "ui/theme.h"

namespace gyre {
namespace {

// A large button: drawing, title, one sentence.
class ChoiceCard final : public QAbstractButton {
 public:
  ChoiceCard(const QString& icon_name, const QString& title, const QString& text)
      : icon_name_(icon_name), text_(text) {
    setText(title);
    setAccessibleName(title);
    setAccessibleDescription(text);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    setMinimumSize(220, 168);
    setMaximumHeight(190);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  }
  QSize sizeHint() const override { return {270, 178}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColours colours = themeColours();
    const bool lit = underMouse() || hasFocus();
    painter.setPen(QPen(lit ? colours.accent : colours.line, lit ? 2.0 : 1.0));
    painter.setBrush(isDown() ? colours.line : colours.card);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1.5, 1.5, -1.5, -1.5), 12, 12);
    themeIcon(icon_name_).paint(&painter, QRect(20, 18, 44, 44), Qt::AlignLeft);
    QFont title_font = font();
    title_font.setPointSizeF(1.25 * title_font.pointSizeF());
    title_font.setWeight(QFont::DemiBold);
    painter.setFont(title_font);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRect(20, 74, width() - 40, 28), Qt::AlignLeft | Qt::AlignVCenter, text());
    painter.setFont(font());
    painter.setPen(colours.muted);
    painter.drawText(QRect(20, 106, width() - 40, height() - 116), Qt::AlignLeft | Qt::TextWordWrap,
                     text_);
  }
  void enterEvent(QEnterEvent*) override { update(); }
  void leaveEvent(QEvent*) override { update(); }

 private:
  QString icon_name_;
  QString text_;
};

QString describe(const RecentScan& scan) {
  QString line = scan.title + "\n" + QLocale().toString(scan.when, QLocale::ShortFormat);
  if (scan.size_mm > 0.0) line += StartPage::tr("  ·  %1 mm").arg(scan.size_mm, 0, 'f', 1);
  return line;
}

}  // namespace

StartPage::StartPage(QWidget* parent) : QWidget(parent) {
  auto* outer = new QHBoxLayout(this);
  outer->addStretch(1);
  auto* layout = new QVBoxLayout;
  outer->addLayout(layout, 8);
  outer->addStretch(1);
  layout->setSpacing(kGap_px);
  layout->addSpacing(36);
  layout->addWidget(makeLabel(tr("Gyre"), "title"));
  layout->addWidget(
      makeLabel(tr("Put a small object on a turntable, press Start, and get a measured 3D model "
                   "in millimetres."),
                "muted"));
  layout->addSpacing(16);

  auto* choices = new QHBoxLayout;
  choices->setSpacing(16);
  auto* demo = new ChoiceCard("demo", tr("Try the demo"),
                              tr("A simulated turntable scans a duck. Nothing to plug in."));
  auto* scan = new ChoiceCard("scan", tr("New scan"),
                              tr("Connect a turntable and a camera and scan an object."));
  auto* open = new ChoiceCard("open", tr("Open"),
                              tr("Look at a scan or a model, or go on with "
                                 "a scan that was interrupted."));
  for (QAbstractButton* card : {demo, scan, open}) choices->addWidget(card);
  layout->addLayout(choices);
  layout->addSpacing(20);

  layout->addWidget(makeLabel(tr("Recent scans"), "heading"));
  nothing_recent_ = makeLabel(tr("Scans will be listed here."), "muted");
  layout->addWidget(nothing_recent_);
  recent_ = new QListWidget;
  recent_->setAccessibleName(tr("Recent scans"));
  recent_->setIconSize({72, 54});
  recent_->setSpacing(2);
  recent_->hide();
  layout->addWidget(recent_, 1);
  layout->addStretch(0);
  devices_ = makeLabel(QString(), "muted");
  layout->addWidget(devices_);
  calibration_ = makeLabel(QString(), "muted");
  calibration_->setAccessibleName(tr("Calibration in use"));
  layout->addWidget(calibration_);
  showCalibration(QString());
  layout->addSpacing(16);

  connect(demo, &QAbstractButton::clicked, this, &StartPage::demoRequested);
  connect(scan, &QAbstractButton::clicked, this, &StartPage::newScanRequested);
  connect(open, &QAbstractButton::clicked, this, &StartPage::openRequested);
  connect(recent_, &QListWidget::itemActivated, this, [this](const QListWidgetItem* item) {
    Q_EMIT recentChosen(item->data(Qt::UserRole).toString());
  });
}

void StartPage::showRecent(const std::vector<RecentScan>& scans) {
  recent_->clear();
  for (const RecentScan& scan : scans) {
    const QPixmap picture(scan.thumbnail);
    auto* item = new QListWidgetItem(picture.isNull() ? themeIcon("cube") : QIcon(picture),
                                     describe(scan), recent_);
    item->setData(Qt::UserRole, scan.folder);
    item->setToolTip(scan.folder);
  }
  recent_->setVisible(!scans.empty());
  nothing_recent_->setVisible(scans.empty());
}

void StartPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  Q_EMIT shown();
}

void StartPage::showCalibration(const QString& sentence) {
  calibration_->setText(sentence.isEmpty()
                            ? tr("Not calibrated yet: a real rig is calibrated once, in step 3.")
                            : tr("Calibration: %1").arg(sentence));
}

void StartPage::showDevices(const QString& sentence) { devices_->setText(sentence); }

}  // namespace gyre
