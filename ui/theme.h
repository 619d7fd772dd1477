// Colours and spacing of the whole window, light or dark.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QIcon>
#include <QString>

class QApplication;

namespace gyre {

enum class ThemeChoice { kFollowSystem, kLight, kDark };

// Sets style, palette and style sheet. kFollowSystem looks at the palette the system gave, so it is
// called first with that one in place.
void applyTheme(QApplication& application, ThemeChoice choice);

// Colours with a meaning; never the only sign of it.
struct ThemeColours {
  QColor accent;
  QColor good;
  QColor warning;
  QColor bad;
  QColor muted;  // secondary text
  QColor card;   // ground of cards and panels
  QColor line;   // thin borders
};
ThemeColours themeColours();

// An icon of resources/icons, in the present text colour unless told. name: without folder and
// ending.
QIcon themeIcon(const QString& name, const QColor& colour = {});

}  // namespace gyre
