// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/count_anew.h"

namespace gyre {

Result<void> countAnewIfLost(Turntable& table) {
  if (table.angleAt(table.place())) return {};
  return table.setAngle(0.0);
}

}  // namespace gyre
