// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_writer.h"

#include <algorithm>
#include <limits>

#include "core/io/glb.h"
#include "core/io/model_format.h"
#include "core/io/obj.h"
#include "core/io/ply.h"
#include "core/io/stl.h"
#include "core/io/three_mf.h"

namespace gyre {

Result<void> writeModel(const std::filesystem::path& file, const Mesh& mesh,
                        const ModelLabel& label) {
  const auto format = modelFormatOf(file);
  if (format == ModelFormat::kPly) return writePly(file, mesh);
  if (format == ModelFormat::kObj) return writeObj(file, mesh);
  if (format == ModelFormat::kStl) return writeStl(file, mesh);
  if (format == ModelFormat::kThreeMf) return writeThreeMf(file, mesh, label);
  if (format == ModelFormat::kGlb) return writeGlb(file, mesh, label);
  return checkModelEnding(file);  // and that fails
}

double movedAlongZ_mm(const std::filesystem::path& file, const Mesh& mesh) {
  const auto format = modelFormatOf(file);
  const bool stays = !format || *format == ModelFormat::kPly || *format == ModelFormat::kObj;
  if (stays || mesh.triangles.empty()) return 0.0;
  double lowest_mm = std::numeric_limits<double>::max();
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      lowest_mm = std::min(lowest_mm, mesh.vertices[corner].position.z());
    }
  }
  return -lowest_mm;
}

Result<void> checkModelEnding(const std::filesystem::path& file) {
  if (modelFormatOf(file)) return {};
  return Error{Error::Code::kInvalidInput,
               "\"" + file.string() + "\" does not end in a known mesh format.",
               "Let the file's name end in .ply, .obj, .stl, .3mf or .glb."};
}

}  // namespace gyre
