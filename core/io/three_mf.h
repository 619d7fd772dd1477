// Writes 3MF: a surface with colours and its unit, for printing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/io/model_label.h"
#include "core/scan/mesh.h"

namespace gyre {

// The file's bytes: millimetres, z up, standing on z = 0, to a millionth of a millimetre. The
// vertices keep the turntable's axis at x = y = 0; since 3MF counts from the front left corner of
// the bed, the object is placed within 1 mm of it. Colours are sRGB, one a vertex. Fails as
// standingMesh() does, and when lib3mf cannot write it.
Result<std::string> threeMfBytes(const Mesh& mesh, const ModelLabel& label = {});

// Replaces the file atomically.
Result<void> writeThreeMf(const std::filesystem::path& file, const Mesh& mesh,
                          const ModelLabel& label = {});

}  // namespace gyre
