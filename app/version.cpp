// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/version.h"

namespace gyre {

const char* programVersion() { return GYRE_VERSION; }

}  // namespace gyre
