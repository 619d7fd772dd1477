// Step 1: which turntable and which camera, what they say of themselves, and small moves by hand.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/device_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLineEdit>

#include "ui/doctor_card.h"
#include "ui/parts.h"
#include "ui/theme.h"

namespace gyre {
namespace {

constexpr int kWordRole = Qt::UserRole;           // what is opened
constexpr int kHindranceRole = Qt::UserRole + 1;  // why it cannot be

// What the box stands for: the chosen entry's word, or what was typed.
QString wordOf(const QComboBox& box) {
  const int at = box.findText(box.currentText());
  return at >= 0 ? box.itemData(at, kWordRole).toString() : box.currentText().trimmed();
}

void addChoice(QComboBox& box, const QString& text, const QString& word, const QString& hindrance) {
  box.addItem(hindrance.isEmpty() ? text : text + QString::fromUtf8("  ⚠"), word);
  box.setItemData(box.count() - 1, hindrance, kHindranceRole);
  box.setItemData(box.count() - 1, hindrance.isEmpty() ? word : hindrance, Qt::ToolTipRole);
}

void keepChoice(QComboBox& box, const QString& word) {
  const int at = box.findData(word, kWordRole);
  if (at >= 0) {
    box.setCurrentIndex(at);
  } else if (!word.isEmpty()) {
    box.setEditText(word);
  }
}

QComboBox* makeChoiceBox(const QString& name, const QString& hint) {
  auto* box = new QComboBox;
  box->setEditable(true);
  box->setInsertPolicy(QComboBox::NoInsert);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setAccessibleName(name);
  box->setToolTip(hint);
  box->lineEdit()->setPlaceholderText(hint);
  box->lineEdit()->setAccessibleName(name);
  return box;
}

QString pathText(const std::string& path, const std::string& description) {
  const QString name = QString::fromStdString(path);
  return description.empty() ? name : name + "  –  " + QString::fromStdString(description);
}

}  // namespace

DevicePanel::DevicePanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGap_px);
  buildChoice(*layout);
  doctor_ = new DoctorCard;
  layout->addWidget(doctor_);
  connect(doctor_, &DoctorCard::checkRequested, this,
          [this] { Q_EMIT checkRequested(turntable()); });
  connect(doctor_, &DoctorCard::stopRequested, this, &DevicePanel::checkStopRequested);
  buildQuestion(*layout);
  buildLock(*layout);
  buildMoves(*layout);
  buildCamera(*layout);
  layout->addStretch(1);
  showPorts({});
  showCameras({});
  showPhase(ScanPhase::kIdle);
}

void DevicePanel::buildChoice(QVBoxLayout& layout) {
  QVBoxLayout* card = nullptr;
  layout.addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Turntable"), "heading"));
  turntable_ = makeChoiceBox(tr("Turntable"), tr("A port, tcp:HOST:PORT, or hand:MARKS"));
  card->addWidget(turntable_);
  card->addWidget(makeLabel(tr("Camera"), "heading"));
  camera_ = makeChoiceBox(tr("Camera"), tr("A camera, or the address of a stream"));
  card->addWidget(camera_);
  hindrance_ = makeLabel(QString(), "muted");
  card->addWidget(hindrance_);
  connect_ = makePrimaryButton(tr("Connect"), tr("Open both and ask who they are; nothing moves"));
  disconnect_ = makeButton(tr("Disconnect"), tr("Let go of turntable and camera"));
  auto* refresh = makeButton(QString(), tr("Look for ports and cameras again"));
  refresh->setIcon(themeIcon("refresh"));
  refresh->setAccessibleName(tr("Look again"));
  auto* row = new QHBoxLayout;
  row->addWidget(connect_, 1);
  row->addWidget(disconnect_, 1);
  row->addWidget(refresh);
  card->addLayout(row);
  connect(connect_, &QPushButton::clicked, this,
          [this] { Q_EMIT connectRequested(turntable(), camera()); });
  connect(disconnect_, &QPushButton::clicked, this, &DevicePanel::disconnectRequested);
  connect(refresh, &QPushButton::clicked, this, &DevicePanel::refreshRequested);
  connect(turntable_, &QComboBox::currentTextChanged, this, &DevicePanel::showHindrance);
  connect(camera_, &QComboBox::currentTextChanged, this, &DevicePanel::showHindrance);
}

void DevicePanel::buildQuestion(QVBoxLayout& layout) {
  QVBoxLayout* card = nullptr;
  question_ = makeCard(card);
  layout.addWidget(question_);
  card->addWidget(makeLabel(tr("Is this your turntable?"), "heading"));
  question_text_ = makeLabel(QString());
  card->addWidget(question_text_);
  auto* yes = makePrimaryButton(tr("Yes, it may turn"), tr("Allow this device to be moved"));
  card->addWidget(yes);
  connect(yes, &QPushButton::clicked, this, [this] {
    allowMoving();
    Q_EMIT turntableConfirmed();
  });
  question_->hide();
}

void DevicePanel::buildLock(QVBoxLayout& layout) {
  QVBoxLayout* card = nullptr;
  lock_ = makeCard(card);
  layout.addWidget(lock_);
  card->addWidget(makeLabel(tr("May the board be unlocked?"), "heading"));
  lock_text_ = makeLabel(QString());
  card->addWidget(lock_text_);
  auto* yes = makePrimaryButton(tr("Unlock it"), tr("Allow that the board is unlocked before its "
                                                    "next move, until it is disconnected"));
  card->addWidget(yes);
  connect(yes, &QPushButton::clicked, this, [this] {
    lock_->hide();
    Q_EMIT unlockAllowed();
  });
  lock_->hide();
}

void DevicePanel::buildMoves(QVBoxLayout& layout) {
  QVBoxLayout* card = nullptr;
  moves_ = makeCard(card);
  layout.addWidget(moves_);
  firmware_ = makeLabel(QString());
  card->addWidget(firmware_);
  angle_ = makeLabel(QString(), "figure");
  angle_->setAccessibleName(tr("Angle of the table"));
  card->addWidget(angle_);
  auto* jog = new QHBoxLayout;
  for (const double by_deg : {-10.0, -1.0, 1.0, 10.0}) {
    const QString text = QString("%1%2°").arg(by_deg > 0 ? "+" : "−").arg(qAbs(by_deg));
    auto* button = makeButton(text, tr("Turn the table by %1 degrees, counter-clockwise from above "
                                       "when positive")
                                        .arg(by_deg));
    button->setMinimumWidth(44);
    button->setStyleSheet("padding-left: 4px; padding-right: 4px;");
    connect(button, &QPushButton::clicked, this,
            [this, by_deg] { Q_EMIT turnRequestedDeg(by_deg); });
    jog->addWidget(button);
  }
  card->addLayout(jog);
  target_deg_ = new QDoubleSpinBox;
  target_deg_->setRange(-360.0, 360.0);
  target_deg_->setDecimals(2);
  target_deg_->setSuffix(QString::fromUtf8(" °"));
  target_deg_->setAccessibleName(tr("Angle to go to, in degrees"));
  target_deg_->setToolTip(tr("Angle to go to, in degrees"));
  auto* go = makeButton(tr("Go"), tr("Turn the table to this angle"));
  auto* release = makeButton(tr("Release"), tr("Let go of the motor, so that it cools and the "
                                               "table can be turned by hand"));
  auto* row = new QHBoxLayout;
  row->addWidget(target_deg_, 1);
  row->addWidget(go);
  row->addWidget(release);
  card->addLayout(row);
  connect(go, &QPushButton::clicked, this,
          [this] { Q_EMIT angleRequestedDeg(target_deg_->value()); });
  connect(release, &QPushButton::clicked, this, &DevicePanel::releaseRequested);
}

void DevicePanel::buildCamera(QVBoxLayout& layout) {
  QVBoxLayout* card = nullptr;
  camera_card_ = makeCard(card);
  layout.addWidget(camera_card_);
  camera_text_ = makeLabel(QString());
  camera_text_->setTextFormat(Qt::RichText);
  card->addWidget(camera_text_);
}

QString DevicePanel::turntable() const { return wordOf(*turntable_); }
QString DevicePanel::camera() const { return wordOf(*camera_); }

void DevicePanel::choose(const QString& turntable, const QString& camera) {
  keepChoice(*turntable_, turntable);
  keepChoice(*camera_, camera);
}

void DevicePanel::showPorts(const std::vector<PortInfo>& ports) {
  const QString before = turntable();
  turntable_->clear();
  for (const PortInfo& port : ports) {
    addChoice(*turntable_, pathText(port.path, port.description), QString::fromStdString(port.path),
              QString::fromStdString(port.hindrance));
  }
  for (const int marks : {36, 72}) {
    addChoice(*turntable_, tr("Turned by hand: %1 marks, %2° apart").arg(marks).arg(360 / marks),
              QString("hand:%1").arg(marks), QString());
  }
  for (const char* object : {"duck", "mouse", "cube", "vase", "bowl", "plate", "plain", "target"}) {
    addChoice(*turntable_, tr("Simulated turntable: %1").arg(object), QString("sim:%1").arg(object),
              QString());
  }
  keepChoice(*turntable_, before);
  showHindrance();
}

void DevicePanel::showCameras(const std::vector<CameraDeviceInfo>& cameras) {
  const QString before = camera();
  camera_->clear();
  for (const CameraDeviceInfo& device : cameras) {
    addChoice(*camera_, pathText(device.path, device.description),
              QString::fromStdString(device.path), QString::fromStdString(device.hindrance));
  }
  addChoice(*camera_, tr("Simulated camera"), "sim", QString());
  keepChoice(*camera_, before);
  showHindrance();
}

void DevicePanel::showHindrance() {
  if (doctor_ != nullptr) doctor_->showChosen(turntable());
  QStringList lines;
  for (const QComboBox* box : {turntable_, camera_}) {
    const int at = box->findText(box->currentText());
    if (at >= 0) lines << box->itemData(at, kHindranceRole).toString();
  }
  lines.removeAll(QString());
  hindrance_->setText(lines.join("\n"));
  hindrance_->setVisible(!lines.isEmpty());
}

void DevicePanel::showPhase(ScanPhase phase) {
  idle_ = phase == ScanPhase::kIdle;
  const bool at_rest =
      phase == ScanPhase::kReady || phase == ScanPhase::kDone || phase == ScanPhase::kFailed;
  doctor_->showPhase(phase);
  offerConnecting();
  connect_->setVisible(!at_rest);
  disconnect_->setVisible(at_rest);
  moves_->setEnabled(at_rest);
  camera_card_->setEnabled(at_rest);
  if (idle_) {
    question_->hide();
    lock_->hide();
    moves_->hide();
    camera_card_->hide();
  }
}

void DevicePanel::offerConnecting() {
  for (QWidget* part : {static_cast<QWidget*>(turntable_), static_cast<QWidget*>(camera_),
                        static_cast<QWidget*>(connect_)}) {
    part->setEnabled(idle_ && !checking_);
  }
}

void DevicePanel::showChecking() {
  checking_ = true;
  doctor_->showBegun();
  offerConnecting();
}

void DevicePanel::showChecked(const std::vector<PortDiagnosis>& ports) {
  checking_ = false;
  doctor_->showPorts(ports);
  offerConnecting();
}

void DevicePanel::showCheckStopped() {
  checking_ = false;
  doctor_->showStopped();
  offerConnecting();
}

void DevicePanel::showTurntable(const TurntableInfo& info) {
  QString text = tr("%1, %2 steps per turn")
                     .arg(QString::fromStdString(info.firmware))
                     .arg(info.steps_per_turn, 0, 'f', 0);
  for (const std::string& hindrance : info.hindrances) {
    text += QString::fromUtf8("\n⚠ ") + QString::fromStdString(hindrance);
  }
  firmware_->setText(text);
  question_text_->setText(tr("%1 answered. A mill or a printer answers the same way, and its "
                             "motors would move.")
                              .arg(QString::fromStdString(info.firmware)));
  moves_->show();
}

void DevicePanel::showCamera(const CameraInfo& info) {
  QString text = QString("<b>%1</b><br>%2 × %3 px")
                     .arg(QString::fromStdString(info.description).toHtmlEscaped())
                     .arg(info.width_px)
                     .arg(info.height_px);
  if (info.frames_per_s > 0.0) text += tr(", %1 pictures a second").arg(info.frames_per_s);
  for (const ControlState& control : info.controls) {
    const QString name = QString::fromStdString(control.name).toHtmlEscaped();
    text += control.locked ? tr("<br>✓ %1 locked at %2").arg(name).arg(control.value)
                           : tr("<br>⚠ %1 not locked. %2")
                                 .arg(name, QString::fromStdString(control.remark).toHtmlEscaped());
  }
  camera_text_->setText(text);
  camera_card_->show();
}

void DevicePanel::showAngleDeg(double angle_deg) {
  angle_->setText(tr("Table at %1°").arg(angle_deg, 0, 'f', 2));
}

void DevicePanel::askWhetherTurntable() {
  question_->show();
  moves_->hide();
}

void DevicePanel::askToUnlock(const QString& lock) {
  lock_text_->setText(lock);
  lock_->setVisible(!lock.isEmpty());
}

void DevicePanel::allowMoving() {
  question_->hide();
  moves_->show();
}

}  // namespace gyre
