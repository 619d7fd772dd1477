// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/chime.h"

#include <QApplication>
#include <QTimer>

namespace gyre {
namespace {

constexpr int kBetween_ms = 260;

}  // namespace

void sound(Chime chime) {
  for (int beat = 0; beat < static_cast<int>(chime); ++beat) {
    QTimer::singleShot(beat * kBetween_ms, qApp, [] { QApplication::beep(); });
  }
}

}  // namespace gyre
