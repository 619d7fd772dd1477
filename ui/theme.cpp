// Colours and spacing of the whole window, light or dark.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme.h"

#include <QApplication>
#include <QFile>
#include <QPainter>
#include <QPalette>
#include <QStyleFactory>
#include <QSvgRenderer>

// Outside of any namespace, as Qt asks: resources of a static library are not found by themselves.
static void initResources() { Q_INIT_RESOURCE(gyre); }

namespace gyre {
namespace {

bool isDark() { return QApplication::palette().color(QPalette::Window).lightness() < 128; }

QPalette makePalette(ThemeChoice choice) {
  const bool dark = choice == ThemeChoice::kDark;
  QPalette palette;
  const QColor text = dark ? 0xe6eaef : 0x1f2732;
  const QColor faint = dark ? 0x76808c : 0x9aa4b0;
  palette.setColor(QPalette::Window, dark ? 0x1b2026 : 0xf3f5f7);
  palette.setColor(QPalette::Base, dark ? 0x14181d : 0xffffff);
  palette.setColor(QPalette::AlternateBase, dark ? 0x20262d : 0xf7f9fa);
  palette.setColor(QPalette::Button, dark ? 0x2a313a : 0xffffff);
  palette.setColor(QPalette::Highlight, dark ? 0x2f97a5 : 0x14808e);
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, dark ? 0x2a313a : 0xffffff);
  palette.setColor(QPalette::Link, dark ? 0x5cc4d1 : 0x0f6f7b);
  for (const auto role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
    palette.setColor(role, text);
    palette.setColor(QPalette::Disabled, role, faint);
  }
  palette.setColor(QPalette::PlaceholderText, faint);
  return palette;
}

constexpr const char* kStyleSheet = R"(
  QPushButton, QToolButton[framed="true"] { padding: 7px 14px; border: 1px solid @line;
    border-radius: 6px; background: palette(button); }
  QPushButton:hover { border-color: @accent; }
  QPushButton:pressed { background: @line; }
  QPushButton:disabled { color: @muted; background: transparent; }
  QPushButton:focus, QToolButton:focus { border: 2px solid @accent; padding: 6px 13px; }
  QPushButton[primary="true"] { background: @accent; color: white; border-color: @accent;
    font-weight: 600; }
  QPushButton[primary="true"]:hover { background: @accentHover; }
  QPushButton[primary="true"]:disabled { background: @line; color: @muted; border-color: @line; }
  QToolButton { padding: 5px; border: 1px solid transparent; border-radius: 6px; }
  QToolButton:hover { border-color: @line; }
  QToolButton:checked { background: @line; }
  QLineEdit { padding: 5px 8px; border: 1px solid @line; border-radius: 6px;
    background: palette(base); min-height: 20px; }
  QLineEdit:focus { border-color: @accent; }
  QComboBox, QSpinBox, QDoubleSpinBox { min-height: 28px; }
  QComboBox QLineEdit, QAbstractSpinBox QLineEdit { border: none; padding: 0px 2px; min-height: 0; }
  QScrollBar:vertical { width: 8px; background: transparent; }
  QScrollBar::handle:vertical { background: @line; border-radius: 4px; min-height: 30px; }
  QScrollBar::add-line, QScrollBar::sub-line { height: 0; }
  QFrame[card="true"] { background: @card; border: 1px solid @line; border-radius: 10px; }
  QLabel[role="title"] { font-size: 22px; font-weight: 600; }
  QLabel[role="heading"] { font-size: 15px; font-weight: 600; }
  QLabel[role="muted"] { color: @muted; }
  QLabel[role="figure"] { font-size: 15px; font-weight: 600; }
  QProgressBar { border: none; border-radius: 3px; background: @line; max-height: 6px;
    min-height: 6px; }
  QProgressBar::chunk { border-radius: 3px; background: @accent; }
  QListWidget, QTreeWidget, QPlainTextEdit { border: 1px solid @line; border-radius: 8px;
    background: palette(base); }
  QListWidget::item { padding: 6px; }
  QSplitter::handle { background: transparent; }
  QScrollArea { border: none; background: transparent; }
  QScrollArea > QWidget > QWidget { background: transparent; }
)";

QString styleSheet() {
  const ThemeColours colours = themeColours();
  QString sheet = QString::fromLatin1(kStyleSheet);
  sheet.replace("@accentHover", colours.accent.lighter(112).name());
  sheet.replace("@accent", colours.accent.name());
  sheet.replace("@line", colours.line.name());
  sheet.replace("@card", colours.card.name());
  sheet.replace("@muted", colours.muted.name());
  return sheet;
}

}  // namespace

void applyTheme(QApplication& application, ThemeChoice choice) {
  initResources();
  if (choice == ThemeChoice::kFollowSystem) {
    choice = isDark() ? ThemeChoice::kDark : ThemeChoice::kLight;
  }
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setPalette(makePalette(choice));
  application.setStyleSheet(styleSheet());
}

ThemeColours themeColours() {
  if (isDark()) {
    return {0x2f97a5, 0x4fbf7c, 0xe0a63a, 0xe8685c, 0x93a0ae, 0x232930, 0x37404a};
  }
  return {0x14808e, 0x23854b, 0xa86a0a, 0xbe3a30, 0x647080, 0xffffff, 0xd9dfe5};
}

QIcon themeIcon(const QString& name, const QColor& colour) {
  QFile file(":/icons/" + name + ".svg");
  if (!file.open(QIODevice::ReadOnly)) return {};
  // The drawings use currentColor, which Qt's SVG does not know.
  QByteArray drawing = file.readAll();
  const QColor ink =
      colour.isValid() ? colour : QApplication::palette().color(QPalette::ButtonText);
  drawing.replace("currentColor", ink.name().toLatin1());
  QSvgRenderer renderer(drawing);
  QIcon icon;
  for (const int size : {16, 24, 32, 48, 64, 96}) {
    QPixmap pixmap(size, size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    renderer.render(&painter);
    painter.end();
    icon.addPixmap(pixmap);
  }
  return icon;
}

}  // namespace gyre
