// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/doctor_card.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QTextDocumentFragment>

#include "ui/parts.h"
#include "ui/theme.h"

namespace gyre {
namespace {

bool isPort(const QString& turntable) {
  return !turntable.isEmpty() && !turntable.startsWith("sim") && !turntable.startsWith("hand");
}

enum class Verdict { kGood, kDoubtful, kBad };

Verdict verdictOf(PortState state) {
  switch (state) {
    case PortState::kReady:
    case PortState::kTurntable:
      return Verdict::kGood;
    case PortState::kHindered:
    case PortState::kLocked:
    case PortState::kMoving:
      return Verdict::kDoubtful;
    default:
      return Verdict::kBad;
  }
}

QColor colourOf(PortState state) {
  const ThemeColours colours = themeColours();
  const Verdict verdict = verdictOf(state);
  return verdict == Verdict::kGood       ? colours.good
         : verdict == Verdict::kDoubtful ? colours.warning
                                         : colours.bad;
}

QString html(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

// What was heard at the speeds at which anything was.
QString answersText(const std::vector<TableAnswer>& answers) {
  QString text;
  for (const TableAnswer& answer : answers) {
    if (answer.heard.empty()) continue;
    text += DoctorCard::tr("<br>%1 baud, asked %2: %3")
                .arg(answer.baud)
                .arg(html(answer.asked), html(answer.heard));
  }
  if (!answers.empty()) {
    text += DoctorCard::tr("<br>Asked %n time(s), each speed in turn.", nullptr,
                           static_cast<int>(answers.size()));
  }
  return text;
}

QString portText(const PortDiagnosis& port) {
  // A mark where a line may be broken: names of devices are long words.
  QString name = html(port.port).replace("/", "/&#8203;");
  QString text =
      QString("<p><b>%1</b><br><span style='color:%2'>%3</span><br>%4")
          .arg(name, colourOf(port.state).name(), portStateText(port.state), html(port.what));
  if (port.state != PortState::kReady && !port.advice.empty()) {
    text += " <b>" + html(port.advice) + "</b>";
  }
  if (port.steps_per_turn > 0.0) {
    text += DoctorCard::tr("<br>%1 steps a turn").arg(port.steps_per_turn, 0, 'f', 0);
    if (port.baud > 0) text += DoctorCard::tr(", %1 baud").arg(port.baud);
  }
  for (const std::string& hindrance : port.hindrances) {
    text += QString::fromUtf8("<br>⚠ ") + html(hindrance);
  }
  if (verdictOf(port.state) == Verdict::kBad) text += answersText(port.answers);
  return text + "</p>";
}

}  // namespace

DoctorCard::DoctorCard(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  auto* card = new QVBoxLayout(this);
  card->setContentsMargins(16, 14, 16, 14);
  card->setSpacing(kGap_px - 4);
  check_ = makeButton(QString(), tr("Ask the chosen port who is there, and look at all others. "
                                    "Nothing is moved"));
  card->addWidget(check_);
  told_ = makeLabel(QString());
  told_->setTextFormat(Qt::RichText);
  told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  told_->setAccessibleName(tr("What is the matter with the ports"));
  card->addWidget(told_);
  copy_ = makeButton(tr("Copy"), tr("Copy this to the clipboard, with the commands in it"));
  card->addWidget(copy_);
  connect(check_, &QPushButton::clicked, this, [this] {
    if (state_ == State::kChecking) {
      Q_EMIT stopRequested();
    } else {
      Q_EMIT checkRequested();
    }
  });
  connect(copy_, &QPushButton::clicked, this, [this] {
    QGuiApplication::clipboard()->setText(
        QTextDocumentFragment::fromHtml(told_->text()).toPlainText().remove(QChar(0x200b)));
  });
  told_->hide();
  copy_->hide();
  offer();
}

void DoctorCard::offer() {
  const bool checking = state_ == State::kChecking;
  check_->setText(checking          ? tr("Stop checking")
                  : isPort(chosen_) ? tr("What is wrong with this port?")
                                    : tr("Why is my turntable not listed?"));
  setVisible(phase_ == ScanPhase::kIdle);
}

void DoctorCard::showPhase(ScanPhase phase) {
  phase_ = phase;
  offer();
}

void DoctorCard::showChosen(const QString& turntable) {
  if (turntable == chosen_) return;
  chosen_ = turntable;
  if (state_ == State::kRest) {
    told_->hide();
    copy_->hide();
  }
  offer();
}

void DoctorCard::showBegun() {
  state_ = State::kChecking;
  told_->setText(isPort(chosen_) ? tr("Asking who is there, at every usual speed. Nothing moves.")
                                 : tr("Looking at all ports…"));
  told_->show();
  copy_->hide();
  offer();
}

void DoctorCard::showPorts(const std::vector<PortDiagnosis>& ports) {
  state_ = State::kRest;
  QString text;
  for (const PortDiagnosis& port : ports) text += portText(port);
  if (ports.empty()) {
    text =
        tr("No serial port, and no adapter of a turntable's board is plugged in. Try another "
           "cable: some carry power only.");
  }
  told_->setText(text);
  told_->show();
  copy_->setVisible(!ports.empty());
  offer();
}

void DoctorCard::showStopped() {
  state_ = State::kRest;
  told_->hide();
  offer();
}

QString portStateText(PortState state) {
  switch (state) {
    case PortState::kReady:
      return DoctorCard::tr("✓ Free; nobody was asked");
    case PortState::kTurntable:
      return DoctorCard::tr("✓ Ready: a turntable");
    case PortState::kHindered:
      return DoctorCard::tr("△ A turntable with settings that hinder it");
    case PortState::kLocked:
      return DoctorCard::tr("△ A turntable, locked");
    case PortState::kNoDevice:
      return DoctorCard::tr("✗ No such device");
    case PortState::kNoDriver:
      return DoctorCard::tr("✗ Plugged in, without a port");
    case PortState::kGrabbed:
      return DoctorCard::tr("✗ Taken by brltty");
    case PortState::kNoPermission:
      return DoctorCard::tr("✗ No permission");
    case PortState::kBusy:
      return DoctorCard::tr("✗ In use by another program");
    case PortState::kMoving:
      return DoctorCard::tr("△ A machine at work");
    case PortState::kGarbled:
      return DoctorCard::tr("✗ Wrong speed (baud)");
    case PortState::kUnknownFirmware:
      return DoctorCard::tr("✗ Unknown firmware");
    case PortState::kSilent:
      return DoctorCard::tr("✗ Nothing answers");
    case PortState::kMotorStands:
      return DoctorCard::tr("✗ The motor stands");
    case PortState::kGone:
      return DoctorCard::tr("✗ Gone while it was asked");
    case PortState::kFailed:
      return DoctorCard::tr("✗ It failed");
  }
  return {};
}

}  // namespace gyre
