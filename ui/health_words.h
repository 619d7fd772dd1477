// What a surface is like, and what cleaning it did, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/scan/clean_report.h"
#include "core/scan/mesh_health.h"

namespace gyre {

// A line each: size, closed or not, where it touches itself, pieces, what no camera saw.
QString healthText(const MeshHealth& health);

// A line for each step that changed something, then one for each number that is another than
// before: "Triangles: 41,244 → 20,000".
QString cleanText(const CleanReport& report);

// Share of the area that no camera saw; 0 where there is no area. [0, 1]
double unseenShare(const MeshHealth& health);

}  // namespace gyre
