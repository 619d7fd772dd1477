// The kinds of surface in the user's words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QString>

#include "core/scan/mesh_method.h"

namespace gyre {

struct SurfaceKind {
  QString name;
  QString sentence;  // what it is good for
};

// A kind without words of its own is named as on the command line.
SurfaceKind surfaceKind(MeshMethod method);

// Those that a list offers, the usual one first.
std::vector<MeshMethod> offeredSurfaceKinds();

}  // namespace gyre
