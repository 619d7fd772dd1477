// Small parts that every panel is made of, in one look.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/parts.h"

namespace gyre {

QLabel* makeLabel(const QString& text, const char* role) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  label->setWordWrap(true);
  return label;
}

QPushButton* makeButton(const QString& text, const QString& tip) {
  auto* button = new QPushButton(text);
  button->setToolTip(tip);
  button->setAccessibleDescription(tip);
  return button;
}

QPushButton* makePrimaryButton(const QString& text, const QString& tip) {
  QPushButton* button = makeButton(text, tip);
  button->setProperty("primary", true);
  return button;
}

QFrame* makeCard(QVBoxLayout*& layout) {
  auto* card = new QFrame;
  card->setProperty("card", true);
  layout = new QVBoxLayout(card);
  layout->setContentsMargins(16, 14, 16, 14);
  layout->setSpacing(kGap_px - 4);
  return card;
}

QFrame* makeRule() {
  auto* rule = new QFrame;
  rule->setFrameShape(QFrame::HLine);
  rule->setFrameShadow(QFrame::Plain);
  rule->setEnabled(false);
  return rule;
}

}  // namespace gyre
