// Small parts that every panel is made of, in one look.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace gyre {

inline constexpr int kGap_px = 12;

// role: "title", "heading", "muted" or "figure" of the style sheet.
QLabel* makeLabel(const QString& text, const char* role = "");
QPushButton* makeButton(const QString& text, const QString& tip);
// The one thing to do next on a page.
QPushButton* makePrimaryButton(const QString& text, const QString& tip);
// A framed card; its contents go into the layout it comes with.
QFrame* makeCard(QVBoxLayout*& layout);
// A line between parts of a panel.
QFrame* makeRule();

}  // namespace gyre
