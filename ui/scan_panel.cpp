// Step 5: how many views, and where they are kept.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/scan_panel.h"

#include <QButtonGroup>
#include <QFileDialog>
#include <QLineEdit>
#include <QRadioButton>
#include <QSpinBox>

#include "ui/parts.h"

namespace gyre {
namespace {

QString diskText(double megabytes) {
  return megabytes < 1000.0 ? ScanPanel::tr("%1 MB").arg(megabytes, 0, 'f', 0)
                            : ScanPanel::tr("%1 GB").arg(megabytes / 1000.0, 0, 'f', 1);
}

}  // namespace

ScanPanel::ScanPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGap_px);
  addTrustQuestion(*layout);  // first: a question is seen without scrolling
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  addViewChoice(*card);
  addFolderChoice(*card);
  start_ = makePrimaryButton(tr("Start the scan"), tr("The table will turn"));
  resume_ = makeButton(tr("Go on with this scan"), tr("Capture the views that are missing"));
  resume_->hide();
  card->addWidget(start_);
  card->addWidget(resume_);
  layout->addStretch(1);
  connect(start_, &QPushButton::clicked, this, &ScanPanel::startRequested);
  connect(resume_, &QPushButton::clicked, this, &ScanPanel::resumeRequested);
}

void ScanPanel::addViewChoice(QVBoxLayout& card) {
  card.addWidget(makeLabel(tr("Views around the object"), "heading"));
  kind_ = new QButtonGroup(this);
  auto* quick = new QRadioButton(tr("Quick: 72 views, 5° apart"));
  auto* full = new QRadioButton(tr("Full: 200 views, 1.8° apart"));
  auto* own = new QRadioButton(tr("Own number"));
  kind_->addButton(quick, 72);
  kind_->addButton(full, 200);
  kind_->addButton(own, 0);
  quick->setChecked(true);
  views_ = new QSpinBox;
  views_->setRange(12, 2000);
  views_->setValue(72);
  views_->setEnabled(false);
  views_->setAccessibleName(tr("Number of views"));
  views_->setToolTip(
      tr("Views over one full turn: more views follow finer relief and take longer"));
  for (QWidget* widget : {static_cast<QWidget*>(quick), static_cast<QWidget*>(full),
                          static_cast<QWidget*>(own), static_cast<QWidget*>(views_)}) {
    card.addWidget(widget);
  }
  views_remark_ = makeLabel(QString(), "muted");
  views_remark_->hide();
  card.addWidget(views_remark_);
  estimate_ = makeLabel(QString(), "muted");
  card.addWidget(estimate_);
  connect(kind_, &QButtonGroup::idClicked, this, [this](int views) {
    views_->setEnabled(views == 0);
    if (views > 0) views_->setValue(views);
  });
  connect(views_, &QSpinBox::valueChanged, this, &ScanPanel::showEstimate);
  connect(views_, &QSpinBox::valueChanged, this, &ScanPanel::viewsChanged);
}

void ScanPanel::addFolderChoice(QVBoxLayout& card) {
  card.addWidget(makeLabel(tr("Keep in"), "heading"));
  auto* row = new QHBoxLayout;
  folder_ = new QLineEdit;
  folder_->setAccessibleName(tr("Folder of the scan"));
  folder_->setToolTip(tr("A new folder: every view is on the disk before the table moves on"));
  auto* browse = makeButton(tr("…"), tr("Choose another place"));
  browse->setAccessibleName(tr("Choose another place"));
  row->addWidget(folder_, 1);
  row->addWidget(browse);
  card.addLayout(row);
  no_room_ =
      makeLabel(tr("⚠ The disk may be too full. Free some space, choose another folder, or "
                   "take fewer views."));
  no_room_->hide();
  card.addWidget(no_room_);
  connect(folder_, &QLineEdit::textChanged, this, [this] { Q_EMIT folderChanged(folder()); });
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getSaveFileName(
        this, tr("A folder for the scan"), folder(), QString(), nullptr, QFileDialog::ShowDirsOnly);
    if (!path.isEmpty()) setFolder(path);
  });
}

void ScanPanel::addTrustQuestion(QVBoxLayout& layout) {
  QVBoxLayout* card = nullptr;
  trust_ = makeCard(card);
  layout.addWidget(trust_);
  card->addWidget(makeLabel(tr("Does all stand as it stood?"), "heading"));
  objection_ = makeLabel(QString());
  card->addWidget(objection_);
  card->addWidget(
      makeLabel(tr("What was captured is kept. Where something was moved after all, the rest would "
                   "not fit it."),
                "muted"));
  auto* trust = makeButton(tr("Go on anyway"), tr("I know that nothing was moved"));
  auto* cancel = makePrimaryButton(tr("Do not go on"), tr("Nothing is lost by it"));
  card->addWidget(makeLabel(tr("Only if you know that nothing was moved:")));
  card->addWidget(trust);
  card->addWidget(cancel);
  trust_->hide();
  connect(cancel, &QPushButton::clicked, trust_, &QFrame::hide);
  connect(trust, &QPushButton::clicked, this, [this] {
    trust_->hide();
    Q_EMIT trustGiven();
  });
}

int ScanPanel::views() const { return views_->value(); }
QString ScanPanel::folder() const { return folder_->text().trimmed(); }
void ScanPanel::setFolder(const QString& folder) { folder_->setText(folder); }

void ScanPanel::setViews(int views) {
  QAbstractButton* preset = kind_->button(views);
  (preset != nullptr && views > 0 ? preset : kind_->button(0))->setChecked(true);
  views_->setEnabled(kind_->checkedId() == 0);
  views_->setValue(views);
}

void ScanPanel::showPhase(ScanPhase phase) {
  const bool at_rest =
      phase == ScanPhase::kReady || phase == ScanPhase::kDone || phase == ScanPhase::kFailed;
  start_->setEnabled(at_rest);
  phase_ = phase;
  if (!at_rest) trust_->hide();
  offerResuming();
  for (QAbstractButton* button : kind_->buttons()) button->setEnabled(!isCapturing(phase));
  views_->setEnabled(!isCapturing(phase) && kind_->checkedId() == 0);
  folder_->setEnabled(!isCapturing(phase));
}

void ScanPanel::showViewsRemark(const QString& remark) {
  views_remark_->setText(remark);
  views_remark_->setVisible(!remark.isEmpty());
}

void ScanPanel::showFacts(const ScanFacts& facts) {
  unfinished_ = facts.views_done < facts.views;
  offerResuming();
}

// A scan of which all views are there may still lack its points.
void ScanPanel::offerResuming() {
  resume_->setVisible(phase_ == ScanPhase::kFailed || (phase_ == ScanPhase::kReady && unfinished_));
}

void ScanPanel::askTrust(const Error& objection) {
  objection_->setText(QString::fromStdString(objection.sentence()));
  trust_->show();
}

void ScanPanel::showCost(const ScanCost& cost) {
  cost_ = cost;
  showEstimate();
}

void ScanPanel::showEstimate() {
  if (!cost_) return;
  const double seconds = cost_->turn_s + cost_->view_s * views();
  const double wanted_mb = cost_->results_mb + cost_->view_mb * views();
  QString text =
      tr("About %1 minutes; at most %2 on the disk").arg(clockText(seconds), diskText(wanted_mb));
  if (cost_->free_mb) text += tr(", which has %1 free").arg(diskText(*cost_->free_mb));
  estimate_->setText(text + ".");
  const bool too_full = cost_->free_mb && *cost_->free_mb < wanted_mb;
  no_room_->setVisible(too_full);
}

}  // namespace gyre
