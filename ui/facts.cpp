// What the window is told of a scan: plain facts, shown as they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/facts.h"

#include <algorithm>
#include <cmath>

namespace gyre {

QString clockText(double seconds) {
  const auto whole = static_cast<long long>(std::lround(std::max(seconds, 0.0)));
  const QString minutes_seconds = QString("%1:%2")
                                      .arg(whole / 60 % 60, whole >= 3600 ? 2 : 1, 10, QChar('0'))
                                      .arg(whole % 60, 2, 10, QChar('0'));
  return whole >= 3600 ? QString("%1:%2").arg(whole / 3600).arg(minutes_seconds) : minutes_seconds;
}

}  // namespace gyre
